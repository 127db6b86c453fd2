// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/types.h"

namespace stroma {

// Equivalent tensile stress (Pa) of a Cauchy stress: sqrt(3/2) of its deviator's norm (von Mises
// 1913).
[[nodiscard]] inline double vonMisesStress(const Mat3& stress) {
  return std::sqrt(1.5) * (stress - stress.trace() / 3 * Mat3::Identity()).norm();
}

}  // namespace stroma
