// SPDX-License-Identifier: Apache-2.0
#include "components/animation/default_animation_loop.h"
#include "components/animation/multi_rate_animation_loop.h"
#include "core/plugin.h"

PLUGIN(animation, "0.1.0", "Apache-2.0", "How often the parts of a step run.")
(stroma::Registry& registry) {
  registry.add<stroma::DefaultAnimationLoop>("DefaultAnimationLoop")
      .doc("Makes every call once a step, as a scene without a loop does.")
      .example("scenes/beam/fixbeam_E6000.xml");
  registry.add<stroma::MultiRateAnimationLoop>("MultiRateAnimationLoop")
      .doc("Makes haptic calls several times a step and visual ones at a lower rate.")
      .domain("Rates are met exactly in simulated time, whatever the time step.")
      .example("scenes/tutorials/elastic_support.xml");
}
