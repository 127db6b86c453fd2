// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// Lumped masses of a state's particles. Gravity of the node acts on them.
class Mass : public Component {
 public:
  static constexpr std::string_view role = "Mass";

  [[nodiscard]] virtual MechanicalState& state() const = 0;
  // Adds each particle's mass (kg); called once everything is bound.
  virtual void addMasses(std::span<double> masses) const = 0;
};

}  // namespace stroma
