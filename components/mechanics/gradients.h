// SPDX-License-Identifier: Apache-2.0
// First-order moving-least-squares gradients in the reference configuration:
//   F_i = sum_j (x_j - x_i) g_ij^T,  g_ij = w_ij M_i^-1 X_ij,  M_i = sum_j w_ij X_ij X_ij^T
// with X_ij = X_j - X_i, so that every linear field has its exact gradient (Mueller et al. 2004).
// Units of g: 1/m.
//
// Neighbourhoods without three independent directions climb down a ladder, by the smallest
// eigenvalue of M over its trace, tau, measured in the metric of the support: from 0.03 the plain
// inverse; from 0.003 the row is widened by the neighbours of its neighbours and fitted again;
// below, M is inverted on its good directions only, and F must be completed in the others.
#pragma once

#include "components/mechanics/neighbourhood.h"

namespace stroma {

// A particle whose neighbours lie in a plane (rank 2), on a line (1), or that has none (0).
struct DeficientParticle {
  Index particle;
  int rank;
  Mat3 axes;  // orthonormal; the first `rank` columns are the good directions
};

struct RankReport {
  Index full = 0, widened = 0, coplanar = 0, colinear = 0, isolated = 0;
};

struct Gradients {
  std::vector<Vec3> values;        // g_ij, by slot of the neighbourhoods
  std::vector<std::uint8_t> rank;  // one a particle
  std::vector<DeficientParticle> deficient;
  RankReport report;
};

// From this tau on a row is fitted as it is.
inline constexpr double soundTau = 0.03;

// Widening changes rows of the neighbourhoods, so transpose them after this.
[[nodiscard]] Gradients computeGradients(ConstVec3Span positions, Neighbourhoods& neighbourhoods);

// Fits row i alone, as it stands, and updates values, rank and deficient (not the report).
// Returns tau.
double fitRow(ConstVec3Span positions, const Neighbourhoods& neighbourhoods, Index i,
              Gradients& gradients);

// F with its missing directions filled in, so that it is a rotation across them: the unit normal of
// the deformed plane, the smallest turn of a line, the identity for an isolated particle.
// Only the good directions of the given F are read.
[[nodiscard]] Mat3 completeGradient(const DeficientParticle& particle, const Mat3& F);

// Derivative of the completed F in the direction dF, at the completed F.
[[nodiscard]] Mat3 completeDerivative(const DeficientParticle& particle, const Mat3& F,
                                      const Mat3& dF);

}  // namespace stroma
