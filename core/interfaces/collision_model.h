// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// A triangle surface that moves with a state and can be searched. It follows cuts
// (topologyChanged).
class CollisionModel : public Component {
 public:
  static constexpr std::string_view role = "CollisionModel";

  [[nodiscard]] virtual MechanicalState& state() const = 0;
};

}  // namespace stroma
