// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "tools/study/job.h"

namespace stroma::study {

struct PoolOptions {
  // started as `program study --one JOB --cores LIST --parent PID`, or with another command
  std::filesystem::path program;
  std::filesystem::path folder;         // jobs/ and logs/ are written below it
  std::vector<std::vector<int>> cores;  // of each place; as many jobs run side by side
  std::string command = "study";
};

struct PoolEvents {
  std::function<void(const Job&)> started;
  std::function<void(const Job&, const Json& result)> finished;
  std::function<bool()> stop;  // asked now and then; true ends the pool and its processes
  std::function<void()> tick;  // about five times a second
};

// Runs every job in a process of its own, so that a crash or a hang of one leaves the others alone:
// a process that ends without a result is noted as "crashed", one that is not done in its time is
// ended and noted as "timed out". False when it was stopped, or no process can be started.
[[nodiscard]] bool runJobs(const std::vector<const Job*>& jobs, const PoolOptions& options,
                           const PoolEvents& events);

// Whether a result answers its job. What crashed or timed out may have had to do with the machine
// and is tried again.
[[nodiscard]] bool isFinal(const Json& result);

}  // namespace stroma::study
