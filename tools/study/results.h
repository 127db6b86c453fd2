// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "tools/study/plan.h"

namespace stroma::study {

using Results = std::map<std::string, Json>;  // by the id of the job; what was not run is missing

// Everything the study found out, as in results.json (tools/study/README.md describes it).
[[nodiscard]] Json summarise(const Study& study, const std::vector<Variation>& plan,
                             const Results& results, const Json& machine);

// The rows of all questions as a table.
[[nodiscard]] std::string csvOf(const Json& summary);

// A table for the terminal, and the answers in words.
[[nodiscard]] std::string textOf(const Json& summary);

}  // namespace stroma::study
