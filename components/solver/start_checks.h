// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/system.h"

namespace stroma {

// Reports the first particle without mass: dynamics have no meaning for it.
void requireMasses(Component& integrator, const System& system);

// Distance (m) of neighbouring particles: the smallest that 32 particles all over the points have
// to their nearest; infinite where there are no two.
[[nodiscard]] double typicalDistance(ConstVec3Span points);

}  // namespace stroma
