// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/solver/conjugate_gradient.h"

namespace stroma {

enum class CgPreconditioner { none, jacobi };
template <>
struct EnumNames<CgPreconditioner> {
  static constexpr std::array<std::pair<CgPreconditioner, std::string_view>, 2> names{
      {{CgPreconditioner::none, "none"}, {CgPreconditioner::jacobi, "jacobi"}}};
};

// Conjugate gradients without a matrix: only products of it are computed. Iterates until |b - A x|
// is at most `tolerance` |b|; when `iterations` are not enough the result is used as it is and
// counted as a limiter.
class CGLinearSolver final : public LinearSolver, private Preconditioner {
 public:
  Attribute<int> iterations{
      this, "iterations", 25, "Largest number of iterations.", {.min = 1, .runtime = true}};
  Attribute<double> tolerance{this,
                              "tolerance",
                              1e-5,
                              "Accepted residual |b - A x| / |b|.",
                              {.min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> threshold{
      this, "threshold", 1e-5,
      "Has no effect: SOFA's bound on |p.Ap| depends on the units, here only "
      "the relative tolerance counts."};
  Attribute<bool> warmStart{this, "warmStart", false,
                            "Starts from the last step's solution instead of zero."};
  Attribute<CgPreconditioner> preconditioner{this, "preconditioner", CgPreconditioner::none,
                                             "none, or jacobi: the inverse of the assembled "
                                             "matrix's 3x3 diagonal blocks, the masses where "
                                             "nothing can be assembled."};
  Attribute<int> lastIterations{
      this, "lastIterations", 0, "Iterations of the last solve.", {.output = true}};
  Attribute<double> lastResidual{
      this, "lastResidual", 0.0, "|b - A x| / |b| of the last solve.", {.output = true}};

  void configure() override;
  // a cut changes which blocks there are
  void topologyChanged(const TopologyChange&) override { patternOf_ = nullptr; }
  void topologyRestored() override { patternOf_ = nullptr; }
  LinearSolution solve(const SystemMatrix& matrix, ConstVec3Span b, Vec3Span x) override;

 private:
  void prepareJacobi(const SystemMatrix& matrix);
  void apply(ConstVec3Span r, Vec3Span z) override;

  Limiter notConverged_{this, "notConverged",
                        "solves that ended at `iterations` before reaching `tolerance`"};
  Limiter negativeCurvature_{this, "negativeCurvature",
                             "solves that ended because the matrix is not positive definite"};
  ConjugateGradient cg_;
  const System* patternOf_ = nullptr;
  BlockMatrix matrix_;
  std::vector<Mat3> inverse_;  // of the diagonal blocks
};

}  // namespace stroma
