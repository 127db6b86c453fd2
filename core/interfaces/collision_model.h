// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// A triangle surface that moves with a state and can be searched.
class CollisionModel : public Component {
 public:
  static constexpr std::string_view role = "CollisionModel";

  [[nodiscard]] virtual MechanicalState& state() const = 0;
  // The topology has changed in the triangles named, at a cost proportional to their number: their
  // nodes are others, or they are new (numbers at the end). A triangle whose three nodes are equal
  // is gone. Called after the state has its new nodes, once for each merged change.
  virtual void topologyChanged(std::span<const Index> triangles) = 0;
};

}  // namespace stroma
