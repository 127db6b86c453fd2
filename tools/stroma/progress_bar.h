// SPDX-License-Identifier: Apache-2.0
// Progress of a run on a terminal (standard error): bar, simulated time, time left. Silent in a
// pipe.
#pragma once

#include <chrono>
#include <cstdint>

namespace stroma::cli {

class ProgressBar {
 public:
  // Steps first+1 to last are about to be made, up to a simulated time.
  ProgressBar(std::uint64_t first, std::uint64_t last, double endTime);
  // After a step; draws at most ten times a second.
  void show(std::uint64_t step, double time);
  // Removes the bar, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t first_, last_;
  double endTime_;
  Clock::time_point begin_ = Clock::now(), drawn_{};
  bool enabled_;
};

}  // namespace stroma::cli
