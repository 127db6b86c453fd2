// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types.h"

namespace stroma::study {

// The displacement field between nodes, at any points: a moving least squares fit (Lancaster &
// Salkauskas 1981) of a quadratic polynomial to the 24 nodes nearest to each point, weighted by
// distance. Quadratic fields are reproduced; where the nodes do not determine a term (one or two
// layers, a line), that term is left out. nodes, displacements: as many; all in m. Independent of
// the method that moved the nodes, so that all methods are compared by the same ruler.
[[nodiscard]] std::vector<Vec3> fitField(ConstVec3Span nodes, ConstVec3Span displacements,
                                         ConstVec3Span points);

}  // namespace stroma::study
