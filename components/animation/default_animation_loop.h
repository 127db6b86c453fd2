// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/animation_loop.h"

namespace stroma {

// Every call is made once a step: the same as a scene without a loop.
class DefaultAnimationLoop final : public AnimationLoop {
 public:
  [[nodiscard]] Rates rates() const override { return {}; }
};

}  // namespace stroma
