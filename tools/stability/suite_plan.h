// SPDX-License-Identifier: Apache-2.0
// From a suite to its runs: every case with every method that applies.
#pragma once

#include "tools/stability/suite.h"
#include "tools/study/job.h"

namespace stroma::stability {

// One cell of the table.
struct Cell {
  std::size_t caseNumber = 0, method = 0;
  std::string notApplicable{};  // why; empty where it is run
  bool skipped = false;         // left out of the quick part, or by the names asked for
  study::Job job{};             // of one that is run
  std::string sceneText{};
};

struct PlanOptions {
  std::filesystem::path out{};
  std::vector<std::string> plugins{}, data{};
  bool quick = false;
  std::vector<std::string> cases{}, methods{};  // only those that fit one; all where empty
};

// All cells, case by case. Scenes are read (not initialised), so that what is wrong with a name, a
// path or a value is reported here, with its place in the suite or in the scene; the same problem
// of several methods once.
[[nodiscard]] std::vector<Cell> makePlan(const Suite& suite, const PlanOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace stroma::stability
