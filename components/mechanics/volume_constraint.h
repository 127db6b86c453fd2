// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/mechanics/mls_force_field.h"

namespace stroma {

// Resists the change of each particle's volume with the energy k/2 V (J - 1)^2 (Mueller et al.
// 2004). It adds k to the bulk modulus of the material: with Lame parameters mu and lambda the body
// behaves as if its Poisson's ratio were (3K - 2mu) / (2 (3K + mu)), K = lambda + 2mu/3 + k. The
// force field evaluates it with its material, in the same pass over the particles.
class VolumeConstraint final : public Component {
 public:
  static constexpr std::string_view role = "VolumeConstraint";

  Attribute<double> stiffness{this,
                              "stiffness",
                              0.0,
                              "Added bulk modulus k.",
                              {.unit = "Pa", .min = 0, .required = true, .runtime = true}};
  Link<MLSForceField> forceField{this, "forceField", "Whose particles and gradients are used.",
                                 Lookup::sameNode};

  void bind() override { forceField->addVolumeStiffness(stiffness); }
  void attributeChanged(const AttributeBase&) override { forceField->changeLaw(); }
};

}  // namespace stroma
