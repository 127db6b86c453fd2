// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/results.h"

namespace stroma::study {

// The folder with the parts of a report, beside the program.
[[nodiscard]] std::filesystem::path reportFolder();

// JSON as a script element may hold it: no "</" or "<!--" ends or opens anything.
[[nodiscard]] std::string inScript(const Json& json);

// The report as one self-contained page: the summary, the pictures of the results, the plotting
// library and everything else are inside. Nothing, with the reason in `problem`, when a part is
// missing in the folder.
[[nodiscard]] std::optional<std::string> reportPage(const Json& summary, const Results& results,
                                                    const std::filesystem::path& folder,
                                                    std::string& problem);

}  // namespace stroma::study
