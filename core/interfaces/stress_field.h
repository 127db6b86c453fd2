// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// A force field that knows the stress at its particles.
class StressField {
 public:
  static constexpr std::string_view role = "StressField";
  virtual ~StressField() = default;

  // Cauchy stress (Pa) of a particle at a trial state; costs what the particle's neighbours do.
  [[nodiscard]] virtual Mat3 stressAt(const StateView& at, Index particle) const = 0;
};

}  // namespace stroma
