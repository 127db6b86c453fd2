// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "components/haptics/haptic_kernel.h"
#include "core/channel.h"
#include "core/rate_keeper.h"

namespace stroma {

// What the haptic side tells the simulation after a tick.
struct HapticReport {
  HapticState state;
  ToolSample device;  // the newest good sample
  bool hasSample = false;
};

// Ticks between a device and a simulation, either called one by one or made by a thread of their
// own. Values cross between the two sides through wait-free buffers in both ways of running. A tick
// takes no lock, allocates nothing and reads no attribute.
class HapticLoop {
 public:
  HapticLoop() = default;
  ~HapticLoop() { stop(); }

  // Before the first tick: `rate` in Hz.
  void connect(HapticDevice& device, double rate);

  // One tick of simulated time, in the caller's thread.
  void tick() noexcept;
  // Ticks at the wall clock's time until stop(). The first is made before this returns, so that the
  // simulation knows where the hand is from its first step on. `priority` as for
  // setThreadPriority(); false when the system refuses it (the thread then runs at ordinary
  // priority).
  [[nodiscard]] bool start(int priority);
  void stop();  // the last thing that the device gets is a force of zero
  [[nodiscard]] bool running() const { return thread_.joinable(); }

  // The simulation's side.
  void publish(const LocalContactModel& model) noexcept { models_.write(model); }
  [[nodiscard]] bool newest(HapticReport& report) noexcept { return reports_.read(report); }
  [[nodiscard]] double now() const noexcept;  // s, on the haptic clock

  [[nodiscard]] PaceStatistics pace() const noexcept { return pace_->statistics(); }
  [[nodiscard]] const DurationHistogram& cpuPerTick() const noexcept { return cpu_; }

  // For lock-step only: everything back to the start, or to where a checkpoint was made.
  struct Memory {
    std::uint64_t ticks = 0;
    HapticState state;
    ToolSample device;
    bool hasSample = false;
  };
  [[nodiscard]] Memory memory() const { return {ticks_, state_, device_, hasSample_}; }
  void restore(const Memory& memory, const LocalContactModel& model);

 private:
  void tickAt(double time, double dt) noexcept;
  void run(const std::stop_token& stopped) noexcept;

  HapticDevice* source_ = nullptr;
  double period_ = 1e-3;  // s
  std::uint64_t ticks_ = 0;
  std::int64_t origin_ = 0;  // of the clock in real time, ns

  // of the haptic side
  HapticState state_;
  LocalContactModel model_;
  ToolSample device_;
  bool hasSample_ = false;

  TripleBuffer<LocalContactModel> models_;
  TripleBuffer<HapticReport> reports_;
  std::unique_ptr<RateKeeper> pace_ = std::make_unique<RateKeeper>(1000);
  DurationHistogram cpu_;
  std::atomic<int> granted_ = -1;  // the priority: 1 or 0, -1 while not known
  std::jthread thread_;
};

}  // namespace stroma
