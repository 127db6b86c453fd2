// SPDX-License-Identifier: Apache-2.0
// What any force field between the nodes of a topology asks of its body.
#pragma once

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// Whether the topology's elements can refer to the state's particles; an error at `link` if not.
[[nodiscard]] bool checkSizes(Component& component, const Link<Topology>& link,
                              const MechanicalState& state);

// Elements do not follow cuts: an error if something in the scene divides this body.
void refuseCuts(Component& component, const MechanicalState& state, const Topology& topology);

// A warning for particles that no element (or spring) has.
void warnOfLooseNodes(Component& component, Index loose, Index all, std::string_view what);

}  // namespace stroma
