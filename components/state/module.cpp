// SPDX-License-Identifier: Apache-2.0
#include "components/state/mechanical_object.h"
#include "core/plugin.h"

PLUGIN(state, "0.1.0", "Apache-2.0", "Particle states.")
(stroma::Registry& registry) {
  registry.add<stroma::MechanicalObject>("MechanicalObject")
      .doc("Positions and velocities of one body's particles.")
      .example("scenes/cornea/pull.xml");
}
