// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/solver/conjugate_gradient.h"
#include "components/solver/packed_factor.h"

namespace stroma {

// Sparse L D L^T factors of the assembled matrix (3x3 blocks; AMD ordering). The factor, in single
// precision, preconditions conjugate gradients with the true product, which makes up for what
// cannot be assembled (forces on mapped states) and for what has changed since the factor was made:
// it is kept over steps as long as they reach `tolerance` within `keepIterations` (as Courtecuisse
// et al., "Real-time simulation of contact and cutting of heterogeneous soft-tissues", 2014, do in
// the background). With keepIterations = 0 every solve factorises.
//
// A matrix that is not positive definite gets `shift` times its own diagonal (absolute values)
// added, ten times as much until all pivots are positive; the shifted system is then solved and
// counted as a limiter.
//
// A cut changes which blocks there are. A factor from before it goes on as a preconditioner like
// any other that has grown old; the next one is made of the blocks there are then.
//
// Checkpoints hold the entries of the matrix that was factorised, so that a run resumes with the
// same factor.
class SparseLDLSolver final : public LinearSolver, private Preconditioner {
 public:
  Attribute<double> tolerance{this,
                              "tolerance",
                              1e-8,
                              "Accepted residual |b - A x| / |b|.",
                              {.min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<int> keepIterations{this,
                                "keepIterations",
                                15,
                                "A factor is kept while this many iterations reach the tolerance; "
                                "0 = factorise in every solve.",
                                {.min = 0, .runtime = true}};
  Attribute<int> iterations{this,
                            "iterations",
                            200,
                            "Largest number of iterations with a new factor.",
                            {.min = 1, .runtime = true}};
  Attribute<double> shift{
      this,
      "shift",
      1e-3,
      "Part of the diagonal that is added first when the matrix is not positive "
      "definite.",
      {.min = 0, .exclusiveMin = true}};
  Attribute<int> lastIterations{
      this, "lastIterations", 0, "Iterations of the last solve.", {.output = true}};
  Attribute<double> lastResidual{
      this, "lastResidual", 0.0, "|b - A x| / |b| of the last solve.", {.output = true}};
  Attribute<int> factorizations{
      this, "factorizations", 0, "Factors made so far.", {.output = true}};

  void start() override;
  void reset() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  LinearSolution solve(const SystemMatrix& matrix, ConstVec3Span b, Vec3Span x) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  void prepare(const SystemMatrix& matrix);
  void analyze(const SystemMatrix& matrix);
  [[nodiscard]] bool factorize(const SystemMatrix& matrix);
  [[nodiscard]] double residualOf(const SystemMatrix& matrix, ConstVec3Span b, ConstVec3Span x);
  [[nodiscard]] bool factorIsPositive();
  void apply(ConstVec3Span r, Vec3Span z) override { packed_.solve(r, z); }

  Limiter notConverged_{this, "notConverged",
                        "solves that ended at `iterations` before reaching `tolerance`"};
  Limiter shifted_{this, "shifted", "solves of a matrix made positive definite by a shift"};
  ConjugateGradient cg_;
  bool analyzed_ = false, holdsFactor_ = false, isShifted_ = false;
  bool cut_ = false;  // since the pattern was found
  BlockMatrix matrix_;
  Sparse lower_;                  // what was factorised
  std::vector<double> restored_;  // its entries in a checkpoint, until the pattern is known
  std::vector<int> restoredOuter_, restoredInner_;  // and the pattern, where cuts have changed it
  BlockFactor factor_;
  PackedFactor packed_;
  std::vector<Vec3> residual_;
};

}  // namespace stroma
