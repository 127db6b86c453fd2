// SPDX-License-Identifier: Apache-2.0
// One run of one variation: all that the process which makes it has to know.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/study/study.h"

namespace stroma::study {

using Json = nlohmann::ordered_json;

struct Job {
  std::string id;     // readable, and with a hash of everything below that decides the result
  std::string label;  // for messages
  std::string scene;  // file with the generated scene
  std::string base;   // file it was made from: meshes are looked for beside it
  std::vector<std::string> overrides, plugins, data;
  std::optional<double> time;  // s
  std::uint64_t steps = 0;
  int repeats = 5, threads = 1;
  double timeBudget = 20, timeout = 600;  // s
  std::vector<Measure> measures;          // their references do not matter here
  std::string result;                     // file to write
  int sideBySide = 1;                     // so many run at the same time
};

[[nodiscard]] Json toJson(const Job& job);
// Throws what nlohmann::json throws when the text is not a job.
[[nodiscard]] Job jobFrom(const Json& json);

// What of the job decides its result, the scene's text apart.
[[nodiscard]] std::string identityOf(const Job& job);

// Reads a whole file, nothing when that is not possible.
[[nodiscard]] std::optional<std::string> readFile(const std::filesystem::path& file);
// Parses a JSON file; null when there is none or it is damaged.
[[nodiscard]] Json readJson(const std::filesystem::path& file);
// Writes a file at once: others see all of it or nothing. False when that is not possible.
[[nodiscard]] bool replaceFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace stroma::study
