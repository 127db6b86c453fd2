// SPDX-License-Identifier: Apache-2.0
// Makes moving-least-squares gradients consistent with the divergence theorem. Plain gradients give
// every linear field its exact gradient, but their nodal quadrature does not turn a constant stress
// into its surface traction, which softens bending badly. The smallest correction delta, measured
// by sum |delta_a(i)|^2 / w_a(i), w = 1 for neighbours and 0.3 for the particle itself, is added
// such that for every particle a
//   sum_i V_i D_a(i) = b_a,   b_a = integral over the surface of phi_a n dS,
// and every row i keeps sum_a D_a(i) = 0 and sum_a D_a(i) X_a^T = I. In the spirit of variationally
// consistent integration (Chen, Hillman, Rueter 2013) and of optimisation-based conservative
// meshfree operators (Trask, Bochev, Perego 2020), but the forces stay derived from an energy.
//
// With the shape functions phi of SurfaceShape and the vector areas A of a closed surface,
// b = phi^T A; loads that travel through the same phi then meet the stress inside exactly. The
// constraints agree when the particle volumes sum to the enclosed volume.
//
// Eliminating the rows' own constraints leaves delta = W (V lambda - P mu(lambda)) and an N x N
// positive semi-definite system in lambda, the same for the three components. Few Jacobi-
// preconditioned conjugate-gradient iterations suffice in practice, each of them keeping linear
// fields exact; the exact solution factorises the matrix.
#pragma once

#include "components/mechanics/gradients.h"

namespace stroma {

struct ProjectionOptions {
  int iterations = 8;  // of conjugate gradients
  bool exact = false;  // sparse Cholesky instead, solved to rounding
};

struct ProjectionReport {
  // |b - sum_i V_i D(i)| over |b|, Euclidean; of a part of the rows: at the particles that these
  // bear on, over the norm of V^(2/3), since b vanishes inside
  double residualBefore = 0, residualAfter = 0;
  double volumeMismatch = 0;  // |sum V - enclosed volume| over the enclosed volume; of all rows
  Index left = 0;  // rows of a part that were left alone: they would have changed too much
};

// Corrects the gradients of all rows of full rank. boundary: b_a in m^2, one a particle.
// Throws std::invalid_argument on sizes that do not agree, std::runtime_error where the matrix
// cannot be factorised.
ProjectionReport makeConsistent(ConstVec3Span positions, const Neighbourhoods& neighbourhoods,
                                const TransposedRows& transposed, std::span<const double> volumes,
                                ConstVec3Span boundary, Gradients& gradients,
                                const ProjectionOptions& options = {});

// The same over some particles' rows only, as after a cut: the other rows stay as they are, and so
// do rows that would change by more than twice their size. Costs what the rows hold.
ProjectionReport makeConsistentLocally(ConstVec3Span positions,
                                       const Neighbourhoods& neighbourhoods,
                                       const TransposedRows& transposed,
                                       std::span<const double> volumes, ConstVec3Span boundary,
                                       std::span<const Index> rows, Gradients& gradients,
                                       const ProjectionOptions& options = {});

}  // namespace stroma
