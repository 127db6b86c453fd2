// SPDX-License-Identifier: Apache-2.0
// Where the time of a step goes: one timer for each call of the schedule.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace stroma {

// Durations in a histogram with bins 4 % apart, so percentiles cost no memory that grows.
class Timer {
 public:
  void add(std::chrono::nanoseconds duration);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double totalMs() const { return static_cast<double>(total_) * 1e-6; }
  [[nodiscard]] double meanMs() const {
    return count_ ? totalMs() / static_cast<double>(count_) : 0;
  }
  [[nodiscard]] double maxMs() const { return static_cast<double>(max_) * 1e-6; }
  [[nodiscard]] double percentileMs(double fraction) const;

 private:
  std::uint64_t count_ = 0, total_ = 0, max_ = 0;
  std::vector<std::uint32_t> bins_;
};

class Profiler {
 public:
  struct Row {
    std::string stage, component, label;
    Timer timer;
  };
  void setEnabled(bool enabled) { enabled_ = enabled; }
  [[nodiscard]] bool enabled() const { return enabled_; }
  // Timers of one stage's calls, in the schedule's order.
  [[nodiscard]] std::vector<Row>& rows(int stage) { return rows_[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const std::vector<Row>& rows(int stage) const {
    return rows_[static_cast<std::size_t>(stage)];
  }
  // Total time of each stage, always kept.
  [[nodiscard]] Timer& stage(int stage) { return stages_[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const Timer& stage(int stage) const {
    return stages_[static_cast<std::size_t>(stage)];
  }
  [[nodiscard]] Timer& step() { return step_; }
  [[nodiscard]] const Timer& step() const { return step_; }
  // Table of calls: count, mean, p50, p99, max in ms.
  [[nodiscard]] std::string text() const;

 private:
  bool enabled_ = false;
  std::vector<std::vector<Row>> rows_{8};
  std::vector<Timer> stages_{8};
  Timer step_;
};

}  // namespace stroma
