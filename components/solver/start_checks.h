// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/system.h"

namespace stroma {

// Reports the first particle without mass: dynamics have no meaning for it.
void requireMasses(Component& integrator, const System& system);

}  // namespace stroma
