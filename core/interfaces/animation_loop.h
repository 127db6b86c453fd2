// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"

namespace stroma {

// How often the parts of a schedule run. A scene without a loop runs everything once a step.
struct Rates {
  double visual = 0;  // publications of pictures and visual mappings a second, 0 = every step
  double haptic = 0;  // haptic ticks a second, 0 = one a step
};

class AnimationLoop : public Component {
 public:
  static constexpr std::string_view role = "AnimationLoop";
  [[nodiscard]] virtual Rates rates() const = 0;
};

}  // namespace stroma
