// SPDX-License-Identifier: Apache-2.0
// One haptic tick, as a function of values.
//
// The stylus of the device and the tool of the scene are two bodies, joined by a spring and a
// damper (virtual coupling; Colgate, Stanley and Brown 1995; Adams and Hannaford 1999). The tool's
// proxy is massless and held out of the planes in which the simulation met the tissue last (god
// object; Zilles and Salisbury 1995), each with its own stiffness, so that at every tick
//
//   K (x - p) + B (v - dp/dt) + sum_i lambda_i n_i + f = 0,   lambda_i = k_i max(0, -gap_i(p)),
//
// with x and v of the stylus, p of the proxy, f what else pulls at the tool (a cut, a grip,
// friction). The hand feels sum lambda n + f: exactly nothing in free space.
//
// Guards, always on: a pose that is not finite or that jumps gives zero force at once, and the
// force comes back slowly; a model or a device that falls silent fades the force out; magnitude and
// slew are limited; a passivity observer and controller (Hannaford and Ryu 2002) see to it that the
// hand gets no more work back than it has done.
#pragma once

#include <array>
#include <cstdint>

#include "core/interfaces/haptic_device.h"

namespace stroma {

inline constexpr int maxContactPlanes = 16;

// A plane stays where it is until the next model: tissue that is felt too stiff for a moment and
// then gives way costs the hand work, whereas one that follows its last velocity pays some back.
//
// Where a sample of the tool meets the tissue: gap(p) = normal . (p + R arm - point), negative
// inside, with the tool's origin p and orientation R.
struct ContactPlane {
  Vec3 arm = Vec3::Zero();      // the touching point in the tool's frame (m)
  Vec3 point = Vec3::Zero();    // on the tissue (m)
  Vec3 normal = Vec3::UnitZ();  // unit, out of the tissue
  double stiffness = 0;         // N/m; 0 = rigid; others are faults
};

// Units of the device unless said otherwise; see HapticController's attributes of the same names.
struct HapticParameters {
  double couplingStiffness = 500;  // K, N/m, in the scene
  double couplingDamping = 0.2;    // B, N s/m, in the scene
  double maxForce = 3;             // N
  double maxForceRate = 500;       // N/s
  double forceScale = 1;           // force at the device over force in the scene
  double positionScale = 1;        // distance in the scene over distance at the device
  Vec3 origin = Vec3::Zero();      // of the device's frame in the scene (m)
  Quat orientation = Quat::Identity();
  double staleAfter = 0.1;      // s
  double decayTime = 0.05;      // s
  double recoveryTime = 0.2;    // s
  double maxSpeed = 10;         // m/s, of the stylus
  double energyReserve = 5e-4;  // J
  double passivityDamping = 1;  // N s/m
};

// What the simulation publishes after a step: values only.
struct LocalContactModel {
  std::uint64_t sequence = 0;  // 0: nothing was published yet
  double time = 0;             // s, of publication, on the haptic clock
  Vec3 force = Vec3::Zero();   // N, on the tool, besides the contacts
  int planeCount = 0;
  std::array<ContactPlane, maxContactPlanes> planes;
  HapticParameters parameters;
};

// What a tick leaves for the next one.
struct HapticState {
  bool started = false;
  bool faulty = false;         // from a fault until the force is back in full
  bool jumped = false;         // the proxy is to be set beside the stylus anew
  std::uint32_t epoch = 0;     // counts the times that the proxy was set and did not move there
  Vec3 stylus = Vec3::Zero();  // of the last good sample, in the device's frame
  Pose proxy;                  // in the scene
  Vec3 force = Vec3::Zero();   // given to the device, in its frame
  double gain = 0;             // of the force, 0 to 1
  double silence = 0;          // s, since the device had a new sample
  std::uint64_t sequence = 0;  // of that sample
  double energy = 0;           // J, work of the hand that it has not got back
  double leastEnergy = 0;      // J
  double idle = 0;             // s without force
  double modelAge = 0;         // s
  std::uint64_t faults = 0;    // ticks with a bad pose or model
  std::uint64_t staleTicks = 0, clampedTicks = 0, slewedTicks = 0, passivityTicks = 0;
};

struct HapticOutput {
  Vec3 force;  // N, for the device, in its frame
  Pose proxy;  // of the tool, in the scene
};

class HapticKernel {
 public:
  // `sample` is of the device, its time on the haptic clock; dt (s) since the last tick. The result
  // depends on the arguments alone. Neither allocates nor blocks.
  [[nodiscard]] static HapticOutput step(const ToolSample& sample, const LocalContactModel& model,
                                         double dt, HapticState& state) noexcept;
};

}  // namespace stroma
