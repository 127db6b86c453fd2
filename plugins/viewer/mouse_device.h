// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <string>
#include <vector>

#include "core/attribute.h"
#include "core/channel.h"
#include "core/interfaces/haptic_device.h"
#include "core/schedule.h"

namespace stroma {

// Where the mouse wants a stylus next.
struct MouseTarget {
  Pose pose;
  std::uint32_t buttons = 0;
  bool jump = false;  // it is put there instead of moving there
};

// A stylus that a person moves with the mouse, in a viewer's window. What the mouse draws is a
// path: the stylus follows it from target to target in a straight line, no faster than `maxSpeed`
// of simulated time, so that a quick stroke in a scene that runs slowly still is the stroke that
// was drawn. Buttons change where the path says so. Without a viewer it rests.
//
// In batch its poses are recorded: as a table for ScriptedDevice they make the same steps again.
// (In real time a HapticController's `record` does that.)
class MouseDevice final : public HapticDevice {
 public:
  Attribute<Vec3> position{
      this, "position", Vec3::Zero(), "Where the stylus rests at the start.", {.unit = "m"}};
  Attribute<std::vector<double>> orientation{
      this, "orientation", {0, 0, 0, 1}, "Its orientation there: a unit quaternion x y z w."};
  Attribute<double> maxSpeed{this,
                             "maxSpeed",
                             0.1,
                             "Speed at which the stylus follows the mouse at most.",
                             {.unit = "m/s", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> maxTurnRate{this,
                                "maxTurnRate",
                                720.0,
                                "Angular speed at which it turns at most.",
                                {.unit = "deg/s", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force last written to the device.",
                        {.unit = "N", .output = true}};

  // Another target behind those that are waiting; false when too many are. One thread calls this.
  [[nodiscard]] bool follow(const MouseTarget& target);

  void configure() override;
  void start() override;
  void reset() override;
  void schedule(Schedule& schedule) override;
  void attributeChanged(const AttributeBase& attribute) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] ToolSample read(double time) noexcept override;
  void write(double time, const Vec3& force, const Vec3& torque) noexcept override;

  // What was read so far, as a table for ScriptedDevice; empty in real time.
  [[nodiscard]] std::string recording() const;

 private:
  struct Key {
    double time = 0;
    Pose pose;
    std::uint32_t buttons = 0;
  };
  void advance(double duration) noexcept;
  void record();
  void dropTargets();
  void showForce(const StepContext& step);

  static constexpr std::size_t waiting = 4096;
  boost::lockfree::spsc_queue<MouseTarget, boost::lockfree::capacity<waiting>> path_;
  // of whoever reads
  Key now_;
  MouseTarget target_;
  bool hasTarget_ = false, begun_ = false;
  std::uint64_t sequence_ = 0;
  std::atomic<double> speed_{0}, turnRate_{0};  // m/s, rad/s
  TripleBuffer<Vec3> felt_;

  bool realTime_ = false;
  Limiter dropped_{this, "dropped", "Targets that came while too many waited, and were left out."};
  std::vector<Key> keys_;  // while moving every read, else the first and the last
};

}  // namespace stroma
