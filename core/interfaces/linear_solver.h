// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/system.h"

namespace stroma {

struct LinearSolution {
  int iterations = 0;
  double residual = 0;  // |b - A x| / |b|
  bool converged = true;
};

// Solves A x = b for the symmetric matrix of an implicit step.
class LinearSolver : public Component {
 public:
  static constexpr std::string_view role = "LinearSolver";

  // The matrix changes a little from call to call; a solver may keep what it prepared earlier as
  // long as the result is within its tolerance. `x` is the start value on entry.
  virtual LinearSolution solve(const SystemMatrix& matrix, ConstVec3Span b, Vec3Span x) = 0;
};

}  // namespace stroma
