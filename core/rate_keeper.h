// SPDX-License-Identifier: Apache-2.0
// A steady pace by absolute deadlines, and how well it was kept.
//
// Deadlines lie whole periods apart on the monotonic clock, so that lateness never adds up. A
// deadline that has passed when its predecessor's work ends is skipped: there are no bursts to
// catch up. A deadline counts as missed when nothing starts within `missAfter` behind it.
//
// The thread that keeps the pace writes the statistics, any other may read them at any time:
// everything is of fixed size, and nothing locks or allocates.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace stroma {

// Counts durations in bins that are 3 % wide (32 in each octave of nanoseconds). One thread adds.
class DurationHistogram {
 public:
  void add(std::int64_t nanoseconds) noexcept;
  [[nodiscard]] std::uint64_t count() const noexcept;
  // The duration (s) that the fraction `part` of all do not exceed, to the width of a bin; 0 when
  // there is none.
  [[nodiscard]] double quantile(double part) const noexcept;
  [[nodiscard]] double max() const noexcept;  // s, exact
  void clear() noexcept;

 private:
  static constexpr int binsPerOctave = 32, octaves = 40;
  [[nodiscard]] static int binOf(std::uint64_t nanoseconds) noexcept;
  [[nodiscard]] static double upperEnd(int bin) noexcept;  // ns
  std::array<std::atomic<std::uint64_t>, binsPerOctave * octaves> bins_{};
  std::atomic<std::int64_t> max_{0};
};

struct PaceStatistics {
  double rate = 0;                             // ticks a second
  double p50 = 0, p99 = 0, p999 = 0, max = 0;  // s, periods between the starts of ticks
  std::uint64_t ticks = 0;
  std::uint64_t deadlines = 0;  // met, missed and skipped
  std::uint64_t misses = 0;
  [[nodiscard]] double missRate() const;
};

class RateKeeper {
 public:
  static constexpr double defaultMissAfter = 1e-3;
  explicit RateKeeper(double rate, double missAfter = defaultMissAfter);  // Hz, s

  // The first deadline is one period from now. Called by the thread that keeps the pace.
  void start() noexcept;
  // Sleeps until the next deadline; returns the time (s) since the last tick's start, or since
  // start().
  double wait() noexcept;

  [[nodiscard]] PaceStatistics statistics() const noexcept;

 private:
  std::int64_t period_, missAfter_;  // ns
  std::int64_t deadline_ = 0, lastTick_ = 0;
  DurationHistogram periods_;
  std::atomic<std::int64_t> firstTick_{0}, newestTick_{0};
  std::atomic<std::uint64_t> ticks_{0}, misses_{0}, deadlines_{0};
};

// Monotonic clock and CPU time of the calling thread, ns.
[[nodiscard]] std::int64_t monotonicNanoseconds() noexcept;
[[nodiscard]] std::int64_t threadCpuNanoseconds() noexcept;

// Puts the calling thread into the real-time class (SCHED_FIFO, 1 to 99), or leaves it in the
// ordinary one (0) with timers as sharp as the system has them. False when the system refuses.
[[nodiscard]] bool setThreadPriority(int priority) noexcept;

}  // namespace stroma
