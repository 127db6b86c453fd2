// SPDX-License-Identifier: Apache-2.0
#include "components/animation/multi_rate_animation_loop.h"

#include "core/scene.h"

namespace stroma {

void MultiRateAnimationLoop::configure() {
  const double stepRate = 1 / scene().dt();
  if (visualRate <= stepRate * (1 + 1e-9)) return;
  warning("rate-too-high",
          "'visualRate' " + visualRate.print() + " Hz is more than the " +
              ValueTraits<double>::print(stepRate) + " steps a second: one picture a step is made",
          "lower visualRate, or the dt of the root node");
}

}  // namespace stroma
