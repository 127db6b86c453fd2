// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace stroma {

// Share of a load that acts at `time` (s): rises from 0 at time 0 to 1 at `rampTime`, with zero
// slope at both ends, so that nothing is struck. 1 at all times without a ramp.
[[nodiscard]] inline double smoothRamp(double time, double rampTime) {
  if (rampTime <= 0) return 1;
  const double s = std::clamp(time / rampTime, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

}  // namespace stroma
