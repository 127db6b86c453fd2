// SPDX-License-Identifier: Apache-2.0
// What a hand does on a cornea: one random gesture after the other, as key poses of a device.
#pragma once

#include <string>

#include "core/random.h"
#include "core/types.h"

namespace stroma::soak {

struct HandPath {
  std::string keyTimes, positions;  // of a ScriptedDevice (s, m)
  int gestures = 0;
};

// Goes down somewhere, presses and drags, comes up; no two gestures are alike.
[[nodiscard]] HandPath touchingHand(UniformRandom& random, double seconds);
// Stabs and cuts a straight or bent line of some millimetres, comes up, rests for a moment.
[[nodiscard]] HandPath cuttingHand(UniformRandom& random, double seconds);

}  // namespace stroma::soak
