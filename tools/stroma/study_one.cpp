// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/study_one.h"

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <iostream>

#include "tools/stroma/command.h"
#include "tools/study/run_job.h"

namespace stroma::cli {

using study::Json;

int runOne(const OneJob& one, const std::function<study::Json(const study::Job&)>& run) {
  if (one.parent > 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != one.parent) return wrongUsage;  // it has ended already
  }
  study::Job job;
  try {
    job = study::jobFrom(study::readJson(one.file));
  } catch (const Json::exception& problem) {
    std::cerr << "stroma: '" << one.file << "' is not a job: " << problem.what() << "\n";
    return wrongUsage;
  }
  if (!one.cores.empty() && !study::pinToCores(one.cores)) {
    std::cerr << "warning: cannot be tied to a core\n";
  }
  const Json result = run(job);
  const bool written =
      study::replaceFile(job.result, result.dump(1, ' ', false, Json::error_handler_t::replace));
  if (!written) std::cerr << "stroma: cannot write '" << job.result << "'\n";
  return written ? done : fileTrouble;
}

void addOneJob(CLI::App& command, OneJob& one) {
  command.add_option("--one", one.file)->group("");
  command.add_option("--cores", one.cores)->delimiter(',')->group("");
  command.add_option("--parent", one.parent)->group("");
}

std::vector<std::vector<int>> placesOnCores(int jobs, int threads) {
  const std::vector<int> cores = study::allowedCores();
  const auto each = static_cast<std::size_t>(threads);
  const auto count = static_cast<std::size_t>(jobs);
  std::vector<std::vector<int>> places;
  if (count * each > cores.size()) {
    std::cerr << "stroma: " << count << " jobs of " << each << " thread" << (each > 1 ? "s" : "")
              << " want " << count * each << " cores; there are " << cores.size() << "\n";
    return places;
  }
  // from the last core on: the first one is where most systems do their own work
  for (std::size_t j = 0; j < count; ++j) {
    const auto end = cores.end() - static_cast<std::ptrdiff_t>(j * each);
    places.emplace_back(end - static_cast<std::ptrdiff_t>(each), end);
  }
  return places;
}

}  // namespace stroma::cli
