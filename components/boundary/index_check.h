// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/attribute.h"
#include "core/component.h"
#include "core/interfaces/mechanical_state.h"

namespace stroma {

// Reports the first index that is no particle of the state, and the first one that occurs twice (a
// force would then act twice, or two threads would write to one particle). True when there is
// neither.
[[nodiscard]] bool checkIndices(Component& component, const Attribute<IndexList>& indices,
                                const MechanicalState& state);

// 0, 1, ..., count - 1.
[[nodiscard]] std::vector<Index> allIndices(Index count);

}  // namespace stroma
