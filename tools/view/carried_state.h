// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/scene.h"

namespace stroma::view {

// Takes clock, positions, velocities and cuts of one scene over into another, initialised one, and
// what those components keep that are of the same type in both. False, with the other scene at its
// start, where the bodies are not the same at rest.
[[nodiscard]] bool carryState(Scene& from, Scene& to);

}  // namespace stroma::view
