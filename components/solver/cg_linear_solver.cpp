// SPDX-License-Identifier: Apache-2.0
#include "components/solver/cg_linear_solver.h"

#include <Eigen/LU>

#include "core/parallel.h"

namespace stroma {

void CGLinearSolver::configure() {
  if (threshold.isSet()) {
    note("cg-threshold",
         "'threshold' has no effect: 'tolerance' alone, which is relative, decides");
  }
}

LinearSolution CGLinearSolver::solve(const SystemMatrix& matrix, ConstVec3Span b, Vec3Span x) {
  const bool jacobi = *preconditioner == CgPreconditioner::jacobi;
  if (jacobi) prepareJacobi(matrix);
  const auto [solution, negativeCurvature] =
      cg_.solve(matrix, jacobi ? this : nullptr, b, x, warmStart, iterations, tolerance);
  if (negativeCurvature) {
    ++negativeCurvature_;
  } else if (!solution.converged) {
    ++notConverged_;
  }
  lastIterations.set(solution.iterations);
  lastResidual.set(solution.residual);
  return solution;
}

void CGLinearSolver::prepareJacobi(const SystemMatrix& matrix) {
  if (patternOf_ != &matrix.system) {
    bool complete = false;
    matrix_ = BlockMatrix(matrix.system.pattern(complete));
    inverse_.resize(static_cast<std::size_t>(matrix_.size()));
    patternOf_ = &matrix.system;
  }
  matrix.assemble(matrix_);
  parallelFor(matrix_.size(), [&](Index i) {
    const Mat3& block = matrix_.diagonal(i);
    Mat3 inverse;
    bool invertible = false;
    // a block that is not positive definite would spoil the inner product of the iteration
    if (Eigen::LLT<Mat3>(block).info() == Eigen::Success) {
      block.computeInverseWithCheck(inverse, invertible, 0.0);
    }
    inverse_[static_cast<std::size_t>(i)] = invertible ? inverse : Mat3::Identity();
  });
}

void CGLinearSolver::apply(ConstVec3Span r, Vec3Span z) {
  parallelFor(static_cast<Index>(r.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    z[i] = inverse_[i] * r[i];
  });
}

}  // namespace stroma
