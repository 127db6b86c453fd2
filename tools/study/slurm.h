// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/job.h"

namespace stroma::study {

// A job array for Slurm's sbatch with one task for each line of the list (a file with the names of
// job files). A task ends with its result written, or without one when its time is over.
[[nodiscard]] std::string slurmScript(const std::vector<const Job*>& jobs,
                                      const std::filesystem::path& program,
                                      const std::filesystem::path& list,
                                      const std::filesystem::path& logs);

// The text as one word of a shell.
[[nodiscard]] std::string shellWord(const std::string& text);

}  // namespace stroma::study
