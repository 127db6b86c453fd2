// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_force_field.h"
#include "components/mechanics/mls_mapping.h"
#include "components/mechanics/volume_constraint.h"
#include "core/plugin.h"

PLUGIN(mechanics, "0.1.0", "Apache-2.0", "Point-based (moving least squares) mechanics.")
(stroma::Registry& registry) {
  registry.add<stroma::MLSForceField>("MLSForceField")
      .doc("Point-based elasticity: total-Lagrangian moving least squares over particles.")
      .domain(
          "strain=\"cauchy\" is for small rotations only; strain=\"green\" loses stiffness in "
          "compression beyond 42 %; corotated and stableNeoHookean hold for any rotation, the "
          "latter for inversion too. Plain gradients are too soft in bending (by 45 % at "
          "eight layers of an irregular cloud); consistent ones converge at second order. Thin "
          "tissue wants three or more "
          "stacked layers and ellipsoidal supports.")
      .example("scenes/cornea/pull.xml");
  registry.add<stroma::VolumeConstraint>("VolumeConstraint")
      .doc("Penalty on each particle's change of volume.")
      .domain(
          "Adds its stiffness to the bulk modulus; the Poisson's ratio does the same without it.")
      .example("scenes/paper/cornea.xml");
  registry.add<stroma::MLSMapping>("MLSMapping")
      .doc("Surface nodes that ride on particles by moving-least-squares shape functions.")
      .example("scenes/cornea/pull.xml");
}
