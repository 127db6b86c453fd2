// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/linear_solver.h"

namespace stroma {

// z = approximate inverse of A times r.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  virtual void apply(ConstVec3Span r, Vec3Span z) = 0;
};

struct ConjugateGradientResult {
  LinearSolution solution;
  bool negativeCurvature = false;  // the matrix is not positive definite
};

// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) for A x = b, until |b - A x| <=
// tolerance |b|. In a direction of negative curvature it stops with what it has, which still points
// downhill (Steihaug 1983); the first direction is returned when there is nothing yet. Storage is
// allocated on the first call.
class ConjugateGradient {
 public:
  // `x` is the start value when `fromX`; otherwise zero is.
  ConjugateGradientResult solve(const SystemMatrix& matrix, Preconditioner* preconditioner,
                                ConstVec3Span b, Vec3Span x, bool fromX, int maxIterations,
                                double tolerance);

 private:
  std::vector<Vec3> r_, z_, p_, q_;
};

// Sum of a_i . b_i, with the same bits at any thread count.
[[nodiscard]] double dot(ConstVec3Span a, ConstVec3Span b);
// y += factor x.
void addScaled(Vec3Span y, double factor, ConstVec3Span x);

}  // namespace stroma
