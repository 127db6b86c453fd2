// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/force_field.h"

namespace stroma {

// A force against the velocity of every particle, f = -c v.
class UniformVelocityDampingForceField final : public ForceField {
 public:
  Attribute<double> dampingCoefficient{this,
                                       "dampingCoefficient",
                                       0.1,
                                       "Force on a particle per unit of its velocity.",
                                       {.unit = "kg/s", .min = 0, .runtime = true}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView&) const override { return 0; }
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                  double damping) const override;
};

}  // namespace stroma
