// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/haptic_loop.h"

#include <algorithm>

namespace stroma {
namespace {

// A late tick counts as at most so many periods: what fades or slews does not leap.
constexpr double longestTick = 4;
constexpr double shortestTick = 0.25;

}  // namespace

void HapticLoop::connect(HapticDevice& device, double rate) {
  source_ = &device;
  period_ = 1 / rate;
  pace_ = std::make_unique<RateKeeper>(rate);
}

double HapticLoop::now() const noexcept {
  if (running()) return 1e-9 * static_cast<double>(monotonicNanoseconds() - origin_);
  return static_cast<double>(ticks_) * period_;
}

void HapticLoop::tickAt(double time, double dt) noexcept {
  ToolSample sample = source_->read(time);
  sample.time = time;
  // no new model: the last one goes on
  static_cast<void>(models_.read(model_));
  const std::uint64_t faults = state_.faults;
  const HapticOutput output = HapticKernel::step(sample, model_, dt, state_);
  source_->write(time, output.force, Vec3::Zero());
  if (state_.faults == faults) {
    device_ = sample;
    hasSample_ = true;
  }
  reports_.write({state_, device_, hasSample_});
}

void HapticLoop::tick() noexcept {
  ++ticks_;
  tickAt(static_cast<double>(ticks_) * period_, period_);
}

bool HapticLoop::start(int priority) {
  granted_ = -1;
  origin_ = monotonicNanoseconds();
  tickAt(0, period_);
  thread_ = std::jthread([this, priority](const std::stop_token& stopped) {
    granted_ = setThreadPriority(priority) ? 1 : 0;
    granted_.notify_one();
    run(stopped);
  });
  granted_.wait(-1);
  return granted_ == 1;
}

void HapticLoop::run(const std::stop_token& stopped) noexcept {
  pace_->start();
  while (!stopped.stop_requested()) {
    const double passed = pace_->wait();
    const std::int64_t begin = threadCpuNanoseconds();
    const double time = 1e-9 * static_cast<double>(monotonicNanoseconds() - origin_);
    tickAt(time, std::clamp(passed, shortestTick * period_, longestTick * period_));
    cpu_.add(threadCpuNanoseconds() - begin);
  }
  source_->write(1e-9 * static_cast<double>(monotonicNanoseconds() - origin_), Vec3::Zero(),
                 Vec3::Zero());
}

void HapticLoop::stop() {
  if (!running()) return;
  thread_.request_stop();
  thread_.join();
}

void HapticLoop::restore(const Memory& memory, const LocalContactModel& model) {
  ticks_ = memory.ticks;
  state_ = memory.state;
  device_ = memory.device;
  hasSample_ = memory.hasSample;
  model_ = model;
  models_.write(model);
  reports_.write({state_, device_, hasSample_});
}

}  // namespace stroma
