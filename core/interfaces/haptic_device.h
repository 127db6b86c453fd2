// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/component.h"
#include "core/types.h"

namespace stroma {

// Position and orientation of a rigid body: a point p of its own frame is at position +
// orientation * p in the scene.
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  [[nodiscard]] Vec3 operator*(const Vec3& p) const { return position + orientation * p; }
};

// What a device says of its stylus, as one value.
struct ToolSample {
  double time = 0;  // s, on the clock of the reader
  Pose pose;
  Vec3 linearVelocity = Vec3::Zero();   // m/s
  Vec3 angularVelocity = Vec3::Zero();  // rad/s
  std::uint32_t buttons = 0;            // bit 0: the trigger (grip closed, blade cutting)
  std::uint64_t sequence = 0;           // counts the samples
};

// The hand's end of a tool: a pose comes from it, a force goes back to it. Both calls are made by
// one thread, at the haptic rate; they neither block nor allocate. In real time
// (SceneOptions::realTime) that is another thread than the scene's: reset(), save() and restore()
// then leave alone what these calls use.
class HapticDevice : public Component {
 public:
  static constexpr std::string_view role = "HapticDevice";

  // The pose at `time` (s): of a device in the world, the newest one.
  [[nodiscard]] virtual ToolSample read(double time) noexcept = 0;
  // Force (N) and torque about the stylus' origin (N m) that the hand is to feel from now on.
  virtual void write(double time, const Vec3& force, const Vec3& torque) noexcept = 0;
};

}  // namespace stroma
