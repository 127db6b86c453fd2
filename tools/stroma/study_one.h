// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "tools/study/job.h"

namespace stroma::cli {

// One variation of a study, in this process.
struct OneJob {
  std::string file;        // job file
  std::vector<int> cores;  // that the process is tied to; none if a scheduler sees to that
  int parent = 0;          // process it must not outlive, 0 = none
};

// Runs it and writes its result; the exit code.
[[nodiscard]] int runOne(const OneJob& one,
                         const std::function<study::Json(const study::Job&)>& run);
// The hidden options by which a pool of jobs starts this program: --one, --cores, --parent.
void addOneJob(CLI::App& command, OneJob& one);
// The cores of each of so many places with so many threads each; none when there are too few, which
// is said on standard error.
[[nodiscard]] std::vector<std::vector<int>> placesOnCores(int jobs, int threads);

}  // namespace stroma::cli
