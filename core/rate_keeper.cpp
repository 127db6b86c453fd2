// SPDX-License-Identifier: Apache-2.0
#include "core/rate_keeper.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <ctime>

namespace stroma {
namespace {

constexpr std::int64_t second = 1'000'000'000;

std::int64_t now(clockid_t clock) noexcept {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<std::int64_t>(t.tv_sec) * second + t.tv_nsec;
}

void sleepUntil(std::int64_t nanoseconds) noexcept {
  const timespec until{static_cast<time_t>(nanoseconds / second),
                       static_cast<long>(nanoseconds % second)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

// There is one writer: reading and storing apart is no race, and cheaper than an atomic addition.
template <class T>
void increase(std::atomic<T>& value, T by) noexcept {
  value.store(value.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

std::int64_t monotonicNanoseconds() noexcept { return now(CLOCK_MONOTONIC); }
std::int64_t threadCpuNanoseconds() noexcept { return now(CLOCK_THREAD_CPUTIME_ID); }

bool setThreadPriority(int priority) noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (priority <= 0) return true;
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

// The leading bit gives the octave, the five bits behind it the bin.
int DurationHistogram::binOf(std::uint64_t nanoseconds) noexcept {
  const std::uint64_t n = std::max<std::uint64_t>(nanoseconds, binsPerOctave);
  const int octave = std::bit_width(n) - 6;
  const auto bin = octave * binsPerOctave + static_cast<int>((n >> octave) - binsPerOctave);
  return std::min(bin, binsPerOctave * octaves - 1);
}

double DurationHistogram::upperEnd(int bin) noexcept {
  return std::ldexp(binsPerOctave + bin % binsPerOctave + 1, bin / binsPerOctave);
}

void DurationHistogram::add(std::int64_t nanoseconds) noexcept {
  const std::int64_t n = std::max<std::int64_t>(nanoseconds, 0);
  increase<std::uint64_t>(bins_[static_cast<std::size_t>(binOf(static_cast<std::uint64_t>(n)))], 1);
  if (n > max_.load(std::memory_order_relaxed)) max_.store(n, std::memory_order_relaxed);
}

std::uint64_t DurationHistogram::count() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& bin : bins_) sum += bin.load(std::memory_order_relaxed);
  return sum;
}

double DurationHistogram::quantile(double part) const noexcept {
  const std::uint64_t total = count();
  if (total == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(total)));
  std::uint64_t sum = 0;
  for (int bin = 0; bin < binsPerOctave * octaves; ++bin) {
    sum += bins_[static_cast<std::size_t>(bin)].load(std::memory_order_relaxed);
    if (sum >= std::max<std::uint64_t>(wanted, 1)) return std::min(1e-9 * upperEnd(bin), max());
  }
  return max();
}

double DurationHistogram::max() const noexcept {
  return 1e-9 * static_cast<double>(max_.load(std::memory_order_relaxed));
}

void DurationHistogram::clear() noexcept {
  for (auto& bin : bins_) bin.store(0, std::memory_order_relaxed);
  max_.store(0, std::memory_order_relaxed);
}

double PaceStatistics::missRate() const {
  return deadlines > 0 ? static_cast<double>(misses) / static_cast<double>(deadlines) : 0;
}

RateKeeper::RateKeeper(double rate, double missAfter)
    : period_(std::max<std::int64_t>(1, std::llround(1e9 / rate))),
      missAfter_(std::llround(1e9 * missAfter)) {}

void RateKeeper::start() noexcept {
  lastTick_ = monotonicNanoseconds();
  deadline_ = lastTick_ + period_;
  firstTick_ = newestTick_ = lastTick_;
  ticks_ = misses_ = deadlines_ = 0;
  periods_.clear();
}

double RateKeeper::wait() noexcept {
  const std::int64_t ready = monotonicNanoseconds();
  const std::int64_t skipped = ready > deadline_ ? (ready - deadline_) / period_ : 0;
  deadline_ += skipped * period_;
  if (ready < deadline_) sleepUntil(deadline_);
  const std::int64_t tick = monotonicNanoseconds();
  // the deadlines skipped were late by what is left of the wait for the newest one, and more
  const std::int64_t lateness = tick - deadline_;
  std::uint64_t missed = lateness > missAfter_ ? 1 : 0;
  for (std::int64_t k = 1; k <= skipped; ++k) {
    if (lateness + k * period_ > missAfter_) {
      missed += static_cast<std::uint64_t>(skipped - k + 1);
      break;
    }
  }
  increase(misses_, missed);
  increase(deadlines_, static_cast<std::uint64_t>(1 + skipped));
  increase<std::uint64_t>(ticks_, 1);
  const std::int64_t period = tick - lastTick_;
  periods_.add(period);
  lastTick_ = tick;
  newestTick_.store(tick, std::memory_order_relaxed);
  deadline_ += period_;
  return 1e-9 * static_cast<double>(period);
}

PaceStatistics RateKeeper::statistics() const noexcept {
  PaceStatistics s;
  s.ticks = ticks_.load(std::memory_order_relaxed);
  s.misses = misses_.load(std::memory_order_relaxed);
  s.deadlines = deadlines_.load(std::memory_order_relaxed);
  const std::int64_t elapsed =
      newestTick_.load(std::memory_order_relaxed) - firstTick_.load(std::memory_order_relaxed);
  s.rate = elapsed > 0 ? 1e9 * static_cast<double>(s.ticks) / static_cast<double>(elapsed) : 0;
  s.p50 = periods_.quantile(0.5);
  s.p99 = periods_.quantile(0.99);
  s.p999 = periods_.quantile(0.999);
  s.max = periods_.max();
  return s;
}

}  // namespace stroma
