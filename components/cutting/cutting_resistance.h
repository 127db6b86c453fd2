// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/cutting/cutting_topology_modifier.h"
#include "core/interfaces/force_field.h"

namespace stroma {

// What cutting costs the hand. On each piece of length L (at rest) of an edge that is inside acts
//   F = -L (toughness s / sqrt(|v|^2 + v0^2) + drag) v,
// v the velocity of the tool there relative to the tissue, s the sine of its angle with the edge.
// The first part is the work of parting, toughness an area cut; it acts while the blade advances
// and vanishes smoothly as it comes to rest, with the speed v0 = `restSpeed`. The tissue around
// each piece gets the opposite force. The factor of v is that of the beginning of the step; in v
// the force is implicit, so that an implicit solver stays stable however light the tissue at the
// blade is. An explicit one takes very short steps.
//
// Forces measured at sharp keratomes (about 0.2 N on some 2 mm) mean 0.05 to 0.25 kJ/m^2; what
// tearing takes is ten times that.
class CuttingResistance final : public ForceField {
 public:
  Attribute<double> toughness{this,
                              "toughness",
                              0.0,
                              "Work of cutting an area.",
                              {.unit = "J/m^2", .min = 0, .required = true, .runtime = true}};
  Attribute<double> drag{this,
                         "drag",
                         0.0,
                         "Friction at the blade's sides: force per length and speed.",
                         {.unit = "N s/m^2", .min = 0, .runtime = true}};
  Attribute<double> restSpeed{this,
                              "restSpeed",
                              1e-3,
                              "Speed below which the blade counts as resting.",
                              {.unit = "m/s", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force on the blade, at the end of the step.",
                        {.unit = "N", .output = true}};
  Attribute<double> work{
      this, "work", 0.0, "Work of the blade against it so far.", {.unit = "J", .output = true}};
  Link<CuttingTopologyModifier> modifier{this, "cutting", "Who cuts.", Lookup::nearest};

  void start() override;
  void reset() override { start(); }
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] MechanicalState& state() const override { return modifier->particles(); }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  // No pattern: the tissue at the blade is another in every step.

 private:
  struct Share {
    Index particle;
    double weight;
  };
  // Tissue around a piece of the edge: F = factor (speed - its mean velocity).
  struct Hold {
    std::vector<Share> shares;
    double factor;    // N s/m
    Vec3 speed, now;  // of the blade there (m/s), and where that is
    [[nodiscard]] Vec3 mean(ConstVec3Span v) const;
  };
  void prepare(const StepContext& step);
  void publish(const StepContext& step);

  std::vector<Hold> holds_;
};

}  // namespace stroma
