// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types.h"

namespace stroma {

// A function of a field u that Newton's method makes least.
class NewtonProblem {
 public:
  virtual ~NewtonProblem() = default;
  [[nodiscard]] virtual double energy(ConstVec3Span u) = 0;
  // r = minus the gradient, zero along held directions.
  virtual void residual(ConstVec3Span u, Vec3Span r) = 0;
  // d = Hessian^-1 r at u.
  virtual void direction(ConstVec3Span u, ConstVec3Span r, Vec3Span d) = 0;
  // Size of the changes of u that rounding makes; smaller ones end the iteration.
  [[nodiscard]] virtual double rounding(ConstVec3Span u) const = 0;
};

struct NewtonOptions {
  int iterations;
  double residual;  // accepted |r|
};

struct NewtonResult {
  int iterations = 0;
  double residual = 0;  // last |r|
  bool converged = false;
  int lineSearchFailures = 0;
};

// Newton's method with a line search on the energy: a step is shortened until it satisfies Armijo's
// condition (Nocedal & Wright 2006, ch. 3). A step is also accepted when both the residual and its
// slope along the step have fallen: where the energy changes by rounding only (Hager & Zhang 2005),
// or has no exact value (a follower load with a moving rim). A step that finds neither is counted,
// and is taken only if it lowers the residual. Storage is allocated on the first call.
class Newton {
 public:
  NewtonResult minimise(NewtonProblem& problem, Vec3Span u, const NewtonOptions& options);
  // |r| at u, for choosing the accepted one.
  [[nodiscard]] double residualAt(NewtonProblem& problem, ConstVec3Span u);

 private:
  enum class Search { accepted, failed };
  [[nodiscard]] Search search(NewtonProblem& problem, Vec3Span u);
  void tryStep(NewtonProblem& problem, ConstVec3Span u, double length);

  std::vector<Vec3> r_, d_, trial_, trialResidual_;
};

}  // namespace stroma
