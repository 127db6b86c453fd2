// SPDX-License-Identifier: Apache-2.0
// What any component between the points of a topology asks of its body, when the scene starts.
#pragma once

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// Elements that are inverted or have no volume at rest.
struct ElementFlaw {
  Index first = -1, count = 0;
};

// Whether the topology's points are the state's particles; an error at `link` if not.
[[nodiscard]] bool checkPoints(Component& component, const Link<Topology>& link,
                               const MechanicalState& state);
// The same, and whether there are elements: `count` of what `plural` calls them.
[[nodiscard]] bool checkElements(Component& component, const Link<Topology>& link,
                                 const MechanicalState& state, std::size_t count,
                                 std::string_view plural);

// An error that names the first of the elements that have a flaw; `nodes` are its own.
void refuseFlaw(Component& component, const Link<Topology>& link, const ElementFlaw& flaw,
                std::size_t count, std::string_view plural, std::span<const Index> nodes,
                std::string_view order);

// For components that do not follow cuts: an error if something in the scene divides this body.
void refuseCuts(Component& component, const MechanicalState& state, const Topology& topology,
                std::string hint);

// A warning for particles that none of the elements has.
void warnOfLooseParticles(Component& component, Index loose, Index all, std::string_view what);

}  // namespace stroma
