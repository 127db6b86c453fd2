// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/particle_sampler.h"
#include "core/plugin.h"

PLUGIN(sampling, "0.1.0", "Apache-2.0", "Particles that fill bodies.")
(stroma::Registry& registry) {
  registry.add<stroma::ParticleSampler>("ParticleSampler")
      .doc("Fills a body with particles: a closed surface, a thin shell, or a box.")
      .domain(
          "Volumes add up to the body's to 1e-12; the same seed gives the same bits at any number "
          "of threads.")
      .example("scenes/cornea/pull.xml");
}
