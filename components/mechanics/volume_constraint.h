// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "components/mechanics/mls_force_field.h"

namespace stroma {

// Resists the change of each particle's volume with the energy k/2 V (J - 1)^2 (Mueller et al.
// 2004). It adds k to the bulk modulus of the material: with Lame parameters mu and lambda the body
// behaves as if its Poisson's ratio were (3K - 2mu) / (2 (3K + mu)), K = lambda + 2mu/3 + k.
class VolumeConstraint final : public ForceField {
 public:
  Attribute<double> stiffness{this,
                              "stiffness",
                              0.0,
                              "Added bulk modulus k.",
                              {.unit = "Pa", .min = 0, .required = true, .runtime = true}};
  Link<MLSForceField> forceField{this, "forceField", "Whose particles and gradients are used.",
                                 Lookup::sameNode};

  VolumeConstraint();
  ~VolumeConstraint() override;
  void bind() override;
  void attributeChanged(const AttributeBase& attribute) override;

  [[nodiscard]] MechanicalState& state() const override { return forceField->state(); }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView& at) override;
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double dampingFactor,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                  double dampingFactor) const override;

 private:
  struct Loops;
  std::unique_ptr<Loops> loops_;
};

}  // namespace stroma
