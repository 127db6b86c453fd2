// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/job.h"

namespace stroma::study {

// Runs one variation in this process and returns its result: how it ended ("done", "diverged" or
// "failed", with a message), its measures, and its times.
//
// The scene is run once to warm up and to be measured; then it is reset and run again until there
// are `repeats` runs that together lasted long enough for the clock, or the time budget is spent,
// but at least one. The time of a step is the median over these runs of the mean time of a run's
// steps: CPU time of the one thread, wall time where there are several.
[[nodiscard]] Json runJob(const Job& job);

// Ties this process and its future threads to processor cores. False when the system refuses.
bool pinToCores(const std::vector<int>& cores);
// The cores this process may use.
[[nodiscard]] std::vector<int> allowedCores();

}  // namespace stroma::study
