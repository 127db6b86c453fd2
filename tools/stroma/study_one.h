// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace stroma::cli {

// One variation of a study, in this process.
struct OneJob {
  std::string file;        // job file
  std::vector<int> cores;  // that the process is tied to; none if a scheduler sees to that
  int parent = 0;          // process it must not outlive, 0 = none
};

// Runs it and writes its result; the exit code.
[[nodiscard]] int runOne(const OneJob& one);

}  // namespace stroma::cli
