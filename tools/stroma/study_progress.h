// SPDX-License-Identifier: Apache-2.0
// Progress of a study on standard error: a line for every variation that is done and, on a
// terminal, a bar with the time left.
#pragma once

#include <chrono>
#include <string>

#include "tools/study/job.h"

namespace stroma::cli {

class StudyProgress {
 public:
  explicit StudyProgress(std::size_t total);
  void started(const study::Job& job);
  void finished(const study::Job& job, const study::Json& result);
  // Draws the bar anew.
  void tick() const;
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t total_, done_ = 0;
  std::string current_;
  Clock::time_point begin_ = Clock::now();
  bool terminal_;
};

}  // namespace stroma::cli
