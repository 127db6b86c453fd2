// SPDX-License-Identifier: Apache-2.0
// Two corrections, at initialisation, of what one-sided neighbourhoods do to first-order gradients.
// A particle at a surface has neighbours on one side only, so its first-order fit sees the gradient
// of a place deeper inside, up to half a spacing away, and bodies whose strain varies towards the
// surface (bending, pressure in a cavity) come out too soft. A step costs the same as without.
//
//  1. One-sided rows are fitted again with quadratic terms beside the linear ones. A ridge holds
//     the quadratic coefficients back where few neighbours determine them; without it single rows
//     grow stiff and the stable step short. Linear fields stay exact.
//  2. Row i then still samples the gradient at a place X_i + d_i. Volumes as weights of those
//     places misjudge every integral of a field that varies, by the first moment sum_i V_i d_i
//     locally; the quadrature weights
//        V'_j = V_j + V_j d_j . sum_k g_jk - sum_i V_i d_i . g_ij,
//     which carry each volume back along -d_i by the gradients themselves, do not, to first order.
//     They sum to the same volume. Masses keep the volumes.
//
// Follow both by makeConsistent() with the weights as volumes.
#pragma once

#include "components/mechanics/gradients.h"

namespace stroma {

// Refits the one-sided rows of full rank; g in 1/m as before.
void refitOneSided(ConstVec3Span positions, const Neighbourhoods& neighbourhoods,
                   Gradients& gradients);

// Weights V' in m^3, one a particle, none below a quarter of its volume: where irregular
// neighbourhoods would ask for that, the places around are moved less. Empty where that is not
// enough.
[[nodiscard]] std::vector<double> quadratureWeights(ConstVec3Span positions,
                                                    const Neighbourhoods& neighbourhoods,
                                                    const TransposedRows& transposed,
                                                    const Gradients& gradients,
                                                    std::span<const double> volumes);

}  // namespace stroma
