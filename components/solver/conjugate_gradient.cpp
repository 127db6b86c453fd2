// SPDX-License-Identifier: Apache-2.0
#include "components/solver/conjugate_gradient.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace stroma {

double dot(ConstVec3Span a, ConstVec3Span b) {
  return parallelSum(static_cast<Index>(a.size()), 0.0, [&](Index begin, Index end) {
    const auto from = static_cast<std::size_t>(begin),
               count = static_cast<std::size_t>(end - begin);
    return flat(a.subspan(from, count)).dot(flat(b.subspan(from, count)));
  });
}

void addScaled(Vec3Span y, double factor, ConstVec3Span x) {
  parallelChunks(static_cast<Index>(x.size()), defaultChunk, [&](Index begin, Index end) {
    const auto from = static_cast<std::size_t>(begin),
               count = static_cast<std::size_t>(end - begin);
    flat(y.subspan(from, count)) += factor * flat(x.subspan(from, count));
  });
}

ConjugateGradientResult ConjugateGradient::solve(const SystemMatrix& matrix,
                                                 Preconditioner* preconditioner, ConstVec3Span b,
                                                 Vec3Span x, bool fromX, int maxIterations,
                                                 double tolerance) {
  const std::size_t n = b.size();
  for (auto* a : {&r_, &z_, &p_, &q_}) a->resize(n);
  const auto precondition = [&] {
    if (preconditioner) {
      preconditioner->apply(r_, z_);
    } else {
      std::ranges::copy(r_, z_.begin());
    }
  };

  std::ranges::copy(b, r_.begin());
  if (fromX) {
    matrix.multiply(x, q_);
    addScaled(r_, -1, q_);
  } else {
    std::ranges::fill(x, Vec3::Zero());
  }
  ConjugateGradientResult result;
  LinearSolution& solution = result.solution;
  const double size = std::sqrt(dot(b, b));
  if (size == 0) {
    std::ranges::fill(x, Vec3::Zero());
    return result;
  }
  const auto converged = [&] {
    solution.residual = std::sqrt(dot(r_, r_)) / size;
    return solution.converged = solution.residual <= tolerance;
  };
  if (converged()) return result;

  precondition();
  std::ranges::copy(z_, p_.begin());
  double rz = dot(r_, z_);
  while (solution.iterations < maxIterations) {
    matrix.multiply(p_, q_);
    ++solution.iterations;
    const double curvature = dot(p_, q_);
    if (!(curvature > 0)) {
      result.negativeCurvature = true;
      if (solution.iterations == 1 && !fromX) std::ranges::copy(p_, x.begin());
      return result;
    }
    const double step = rz / curvature;
    addScaled(x, step, p_);
    addScaled(r_, -step, q_);
    if (converged()) return result;
    precondition();
    const double next = dot(r_, z_);
    const double turn = next / rz;
    rz = next;
    parallelFor(static_cast<Index>(n), [&](Index k) {
      const auto i = static_cast<std::size_t>(k);
      p_[i] = z_[i] + turn * p_[i];
    });
  }
  return result;
}

}  // namespace stroma
