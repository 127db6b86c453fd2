// SPDX-License-Identifier: Apache-2.0
#include "components/stability/initial_motion.h"
#include "components/stability/stability_check.h"
#include "core/plugin.h"

PLUGIN(stability, "0.1.0", "Apache-2.0", "Criteria that a run has to meet, and hard starts for it.")
(stroma::Registry& registry) {
  registry.add<stroma::StabilityCheck>("StabilityCheck")
      .doc("Criteria in numbers that a run has to meet: speed, energy, momentum, volume, recovery.")
      .example("tests/stability/flattened.xml");
  registry.add<stroma::InitialMotion>("InitialMotion")
      .doc("Positions and velocities to start from: scrambled, deformed, turned, spinning.")
      .domain("The same seed gives the same bits.")
      .example("tests/stability/scrambled.xml");
}
