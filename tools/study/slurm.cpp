// SPDX-License-Identifier: Apache-2.0
#include "tools/study/slurm.h"

#include <algorithm>
#include <cmath>

namespace stroma::study {

std::string shellWord(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string slurmScript(const std::vector<const Job*>& jobs, const std::filesystem::path& program,
                        const std::filesystem::path& list, const std::filesystem::path& logs) {
  int threads = 1;
  double seconds = 0;
  for (const Job* job : jobs) {
    threads = std::max(threads, job->threads);
    seconds = std::max(seconds, job->timeout);
  }
  const auto minutes = static_cast<long>(std::ceil(seconds / 60)) + 1;
  return "#!/bin/bash\n"
         "#SBATCH --job-name=stroma-study\n"
         "#SBATCH --array=1-" +
         std::to_string(jobs.size()) +
         "\n"
         "#SBATCH --ntasks=1\n"
         "#SBATCH --cpus-per-task=" +
         std::to_string(threads) +
         "\n"
         "#SBATCH --time=" +
         std::to_string(minutes) +
         "\n"
         "#SBATCH --output=\"" +
         (logs / "slurm-%a.txt").string() +
         "\"\n"
         "set -euo pipefail\n"
         "job=$(sed -n \"${SLURM_ARRAY_TASK_ID}p\" " +
         shellWord(list.string()) +
         ")\n"
         "exec " +
         shellWord(program.string()) + " study --one \"$job\"\n";
}

}  // namespace stroma::study
