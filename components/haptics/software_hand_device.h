// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/interfaces/haptic_device.h"

namespace stroma {

// A hand that holds the stylus, simulated: mass m on a spring k and a damper c whose other end
// follows an intention, a polyline in time. The force of the scene acts on the mass, so the coupled
// loop is closed and its stability can be measured without a device:
//
//   m x'' = k (w - x) + c (w' - x') - d x' + f,    w(t) the intention
//
// The force of a tick is held until the next one, as a device does it; the motion between is
// integrated in short implicit steps. A human hand on a pen has 0.05 to 1 kg, 2 to 10 N s/m and
// 50 to 1000 N/m (Hogan 1989; Kuchenbecker, Park and Niemeyer 2003).
class SoftwareHandDevice final : public HapticDevice {
 public:
  Attribute<std::vector<double>> keyTimes{this,
                                          "keyTimes",
                                          {},
                                          "Times of the positions, rising; before the first and "
                                          "after the last the intention rests.",
                                          {.unit = "s"}};
  Attribute<std::vector<Vec3>> positions{
      this,
      "positions",
      {},
      "Where the hand means to be, in the device's frame; straight between.",
      {.unit = "m", .required = true}};
  Attribute<Quat> orientation{this, "orientation", Quat::Identity(), "Of the stylus."};
  Attribute<std::vector<double>> pressed{
      this,
      "pressed",
      {},
      "Times at which the trigger is pressed and let go, in turn.",
      {.unit = "s"}};
  Attribute<double> mass{
      this, "mass", 0.2, "Of hand and stylus.", {.unit = "kg", .min = 0.0, .exclusiveMin = true}};
  Attribute<double> stiffness{this,
                              "stiffness",
                              200.0,
                              "k, of the hand's grip on its intention.",
                              {.unit = "N/m", .min = 0}};
  Attribute<double> damping{
      this, "damping", 3.0, "c, of the hand's grip.", {.unit = "N s/m", .min = 0}};
  Attribute<double> friction{
      this, "friction", 0.05, "d, of the device's joints.", {.unit = "N s/m", .min = 0}};

  void bind() override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] ToolSample read(double time) noexcept override;
  void write(double time, const Vec3& force, const Vec3& torque) noexcept override;

 private:
  struct Motion {
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  };
  [[nodiscard]] Motion intention(double time) const noexcept;
  void advance(double duration) noexcept;
  void rest();  // at the start of the intention

  // copies of the attributes, which the haptic thread must not touch
  std::vector<double> times_, pressed_;
  std::vector<Vec3> places_;
  Quat orientation_ = Quat::Identity();
  double mass_ = 0, stiffness_ = 0, damping_ = 0, friction_ = 0;

  Motion hand_;
  Vec3 force_ = Vec3::Zero();
  double time_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace stroma
