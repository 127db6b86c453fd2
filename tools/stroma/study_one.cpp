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

int runOne(const OneJob& one) {
  if (one.parent > 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != one.parent) return wrongUsage;  // it has ended already
  }
  study::Job job;
  try {
    job = study::jobFrom(study::readJson(one.file));
  } catch (const Json::exception& problem) {
    std::cerr << "stroma: '" << one.file << "' is not a job of a study: " << problem.what() << "\n";
    return wrongUsage;
  }
  if (!one.cores.empty() && !study::pinToCores(one.cores)) {
    std::cerr << "warning: cannot be tied to a core\n";
  }
  const Json result = study::runJob(job);
  const bool written =
      study::replaceFile(job.result, result.dump(1, ' ', false, Json::error_handler_t::replace));
  if (!written) std::cerr << "stroma: cannot write '" << job.result << "'\n";
  return written ? done : fileTrouble;
}

}  // namespace stroma::cli
