// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "components/xpbd/tetrahedron_pairs.h"
#include "components/xpbd/xpbd_mesh_constraint.h"

namespace stroma {

// Constraints on the tetrahedra of a topology, at rest at the state's rest positions.
class XpbdTetrahedra : public XpbdMeshConstraint {
 public:
  void bind() override;
  void attributeChanged(const AttributeBase&) override { pairs_->setModuli(moduli()); }
  void clearMultipliers() override { pairs_->clearMultipliers(); }
  void project(const XpbdParticles& particles) override {
    skipped_.add(pairs_->project(particles, damping));
  }

 protected:
  [[nodiscard]] virtual TetrahedronModuli moduli() const = 0;
  [[nodiscard]] Index elementCount() const { return pairs_->count(); }

 private:
  std::optional<TetrahedronPairs> pairs_;
};

// Stable neo-Hookean tetrahedra as two constraints each (tetrahedron_pairs.h). With mu and
// l = lambda + mu the small-strain moduli are the given ones, and the energy is that of
// TetrahedronHyperelasticityFEMForceField with materialName="StableNeoHookean".
class XpbdTetrahedronConstraint final : public XpbdTetrahedra {
 public:
  static constexpr std::string_view role = "XPBDTetrahedronConstraint";

  Attribute<double> youngModulus{this,
                                 "youngModulus",
                                 5000.0,
                                 "Young's modulus.",
                                 {.unit = "Pa", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> poissonRatio{
      this,
      "poissonRatio",
      0.45,
      "Poisson's ratio.",
      {.min = -1, .max = 0.5, .exclusiveMin = true, .exclusiveMax = true, .runtime = true}};

  [[nodiscard]] Index count() const override { return 2 * elementCount(); }

 protected:
  [[nodiscard]] TetrahedronModuli moduli() const override;
};

// Keeps the volume of each tetrahedron: C = det F - 1, energy V stiffness/2 C^2. What else holds
// the body's shape is for other constraints and force fields.
class XpbdVolumeConstraint final : public XpbdTetrahedra {
 public:
  static constexpr std::string_view role = "XPBDVolumeConstraint";

  Attribute<double> stiffness{
      this,
      "stiffness",
      0.0,
      "Pressure per relative change of volume.",
      {.unit = "Pa", .min = 0, .exclusiveMin = true, .required = true, .runtime = true}};

  [[nodiscard]] Index count() const override { return elementCount(); }

 protected:
  [[nodiscard]] TetrahedronModuli moduli() const override { return {0, stiffness}; }
};

}  // namespace stroma
