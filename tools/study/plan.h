// SPDX-License-Identifier: Apache-2.0
// From a study to the runs that answer it: every combination of methods and axes, each as a scene
// of its own.
#pragma once

#include "tools/study/job.h"

namespace stroma::study {

struct Variation {
  std::size_t question = 0;
  std::string method{};                                       // of a reference run: its name
  std::vector<std::pair<std::string, std::string>> points{};  // axis and point
  std::optional<Quantity> h{};
  bool isReference = false;
  Job job{};
  std::string sceneText{};
};

struct PlanOptions {
  std::filesystem::path out, cache;  // folders of results, and of those of reference runs
  std::vector<std::string> plugins, data;
};

// Combinations that are not skipped, methods first, then the axes in their order; nothing of the
// jobs is filled in.
[[nodiscard]] std::vector<Variation> combinations(const Question& question, std::size_t number);

// All runs of the study, reference runs first. Scenes are read (not initialised), so that what is
// wrong with a name, a path or a value anywhere is reported here, with its place in the study or in
// the scene; the same problem of several variations is reported once.
[[nodiscard]] std::vector<Variation> makePlan(const Study& study, const PlanOptions& options,
                                              Diagnostics& diagnostics);

// Whether the measure is taken of the method, or of the reference run of this name.
[[nodiscard]] bool isOf(const Measure& measure, std::string_view method);

// "MLS, layers 4"; of a reference run "reference 'fine'".
[[nodiscard]] std::string labelOf(const Variation& variation);

}  // namespace stroma::study
