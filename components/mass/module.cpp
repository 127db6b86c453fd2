// SPDX-License-Identifier: Apache-2.0
#include "components/mass/diagonal_mass.h"
#include "components/mass/uniform_mass.h"
#include "core/plugin.h"

PLUGIN(mass, "0.1.0", "Apache-2.0", "Lumped masses.")
(stroma::Registry& registry) {
  registry.add<stroma::UniformMass>("UniformMass")
      .doc("The same mass for every particle.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<stroma::DiagonalMass>("DiagonalMass")
      .doc("Mass of each particle from a density and the volume it stands for.")
      .example("scenes/cornea/pull.xml");
}
