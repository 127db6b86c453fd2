// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/animation_loop.h"

namespace stroma {

// Haptic calls are made several times a step, visual ones only in some steps. By the end of step n,
// at time t = n dt, exactly floor(t rate) calls have been made: the rates hold over any time,
// without drift.
class MultiRateAnimationLoop final : public AnimationLoop {
 public:
  Attribute<double> hapticRate{this,
                               "hapticRate",
                               1000.0,
                               "Haptic calls a second of simulated time.",
                               {.unit = "Hz", .min = 0.0, .exclusiveMin = true}};
  Attribute<double> visualRate{
      this,
      "visualRate",
      60.0,
      "Pictures and visual mappings a second of simulated time; at most one a "
      "step is made.",
      {.unit = "Hz", .min = 0.0, .exclusiveMin = true}};

  void configure() override;
  [[nodiscard]] Rates rates() const override { return {visualRate, hapticRate}; }
};

}  // namespace stroma
