// SPDX-License-Identifier: Apache-2.0
// Picks points that keep their distance from one another: weighted sample elimination (Yuksel,
// Sample Elimination for Generating Poisson Disk Sample Sets, 2015). Gives exactly the wanted
// number, needs no boundary, and is as good for surfaces as for volumes.
#pragma once

#include <vector>

#include "core/types.h"

namespace stroma {

// Indices, ascending, of `count` of the candidates. `radius` (m) is the distance that `count`
// points could have at most from one another in the densest packing. Without randomness of its own.
[[nodiscard]] std::vector<Index> eliminateSamples(ConstVec3Span candidates, Index count,
                                                  double radius);

}  // namespace stroma
