// SPDX-License-Identifier: Apache-2.0
// What the runs of a suite came to.
#pragma once

#include <map>

#include "tools/stability/suite_plan.h"

namespace stroma::stability {

using Results = std::map<std::string, study::Json>;  // by id of the job

// {"format": "stroma-stability 1", "title", "text", "file", "machine", "methods": [{name, text}],
// "cases": [{"name", "text", "scene", "state": "passed" | "failed" | "not run", "cells":
// [{"method", "state": "passed" | "failed" | "not applicable" | "not run", "why", "id", ...of
// runCase but the picture}]}], "elsewhere": [{name, test, text}], "totals": {cases, passed, failed,
// runs}}
[[nodiscard]] study::Json summarise(const Suite& suite, const std::vector<Cell>& cells,
                                    const Results& results, const study::Json& machine);

// The table for people, then what failed and why, the limiters that acted, and as the last line
// "30 cases: 30 passed, 0 failed".
[[nodiscard]] std::string textOf(const study::Json& summary);

// One page with the same and a picture of every end; nothing until the parts of the page are found.
[[nodiscard]] std::optional<std::string> pageOf(const study::Json& summary, const Results& results,
                                                const std::filesystem::path& parts,
                                                std::string& problem);

}  // namespace stroma::stability
