// SPDX-License-Identifier: Apache-2.0
#include "components/solver/sparse_ldl_solver.h"

#include <algorithm>
#include <cmath>

#include "core/scene.h"
#include "core/snapshot.h"
#include "core/traverse.h"

namespace stroma {

void SparseLDLSolver::start() {
  int users = 0;
  forEachComponent(scene().root(), [&](Component& c) {
    for (const LinkBase* link : c.links()) {
      users += static_cast<int>(std::ranges::count(link->components(), this));
    }
  });
  if (users > 1) {
    error("solver-shared", "is used by " + std::to_string(users) + " solvers",
          "its factor belongs to one system: give each solver its own");
  }
}

void SparseLDLSolver::reset() {
  holdsFactor_ = isShifted_ = false;
  restored_.clear();
  restoredOuter_.clear();
}

LinearSolution SparseLDLSolver::solve(const SystemMatrix& matrix, ConstVec3Span b, Vec3Span x) {
  if (b.empty()) return {0, 0, true};  // no particles: a factor of nothing has no pivots
  prepare(matrix);
  ConjugateGradientResult result;
  result.solution.converged = false;
  const bool tryKept = holdsFactor_ && !isShifted_ && keepIterations > 0;
  if (tryKept) {
    result = cg_.solve(matrix, this, b, x, false, keepIterations, tolerance);
  }
  if (!result.solution.converged) {
    const bool usable = factorize(matrix);
    if (isShifted_) {
      // the true matrix has no minimum to iterate to: the shifted system's solution is taken
      ++shifted_;
      if (!usable) ++notConverged_;
      if (usable) flat(x) = factor_.solve(flat(b));
      result.solution = {1, residualOf(matrix, b, x), usable};
    } else {
      result = cg_.solve(matrix, this, b, x, false, iterations, tolerance);
      if (!result.solution.converged) ++notConverged_;
    }
  }
  lastIterations.set(result.solution.iterations);
  lastResidual.set(result.solution.residual);
  return result.solution;
}

void SparseLDLSolver::topologyChanged(const TopologyChange&) { cut_ = true; }

void SparseLDLSolver::topologyRestored() {
  analyzed_ = cut_ = false;
  reset();
}

void SparseLDLSolver::analyze(const SystemMatrix& matrix) {
  bool complete = false;
  matrix_ = BlockMatrix(matrix.system.pattern(complete));
  lower_ = matrix_.lower();
  factor_.analyzePattern(lower_);
  analyzed_ = true;
  cut_ = false;
}

void SparseLDLSolver::prepare(const SystemMatrix& matrix) {
  if (!restoredOuter_.empty()) {
    lower_ =
        Eigen::Map<const Sparse>(static_cast<Eigen::Index>(restoredOuter_.size()) - 1,
                                 static_cast<Eigen::Index>(restoredOuter_.size()) - 1,
                                 static_cast<Eigen::Index>(restored_.size()), restoredOuter_.data(),
                                 restoredInner_.data(), restored_.data());
    factor_.analyzePattern(lower_);
    analyzed_ = cut_ = true;
    restoredOuter_.clear();
    restoredInner_.clear();
  }
  if (!analyzed_) analyze(matrix);
  if (restored_.empty()) return;
  if (static_cast<Eigen::Index>(restored_.size()) == lower_.nonZeros()) {
    std::ranges::copy(restored_, lower_.valuePtr());
    holdsFactor_ = factorIsPositive();
  }
  restored_.clear();
}

double SparseLDLSolver::residualOf(const SystemMatrix& matrix, ConstVec3Span b, ConstVec3Span x) {
  residual_.resize(b.size());
  matrix.multiply(x, residual_);
  const double size = flat(b).norm();
  return size > 0 ? (flat(b) - flat(Vec3Span(residual_))).norm() / size : 0;
}

// False when no shift makes the matrix positive definite.
bool SparseLDLSolver::factorize(const SystemMatrix& matrix) {
  if (cut_) analyze(matrix);
  matrix.assemble(matrix_);
  lower_ = matrix_.lower();
  factorizations.set(factorizations + 1);
  holdsFactor_ = true;
  isShifted_ = false;
  if (factorIsPositive()) return true;
  isShifted_ = true;
  const Eigen::VectorXd diagonal = lower_.diagonal();
  const double floor = 1e-12 * diagonal.cwiseAbs().maxCoeff();
  double added = 0;
  for (double wanted = shift; wanted < 1e12; wanted *= 10) {
    for (Eigen::Index i = 0; i < lower_.cols(); ++i) {
      lower_.coeffRef(i, i) += (wanted - added) * std::max(std::abs(diagonal[i]), floor);
    }
    added = wanted;
    if (factorIsPositive()) return true;
  }
  return false;
}

bool SparseLDLSolver::factorIsPositive() {
  factor_.factorize(lower_);
  if (factor_.info() != Eigen::Success) return false;
  const Eigen::VectorXd pivots = factor_.vectorD();
  // pivots at the level of rounding belong to motions without stiffness
  if (!(pivots.minCoeff() > 1e-14 * pivots.maxCoeff())) return false;
  packed_ = PackedFactor(factor_);
  return true;
}

void SparseLDLSolver::save(StateWriter& writer) const {
  writer.write("factorizations", factorizations.value());
  writer.write("shifted", static_cast<int>(isShifted_));
  const bool waiting = !restored_.empty();
  const std::span<const double> entries(
      waiting ? restored_.data() : lower_.valuePtr(),
      waiting ? restored_.size() : static_cast<std::size_t>(holdsFactor_ ? lower_.nonZeros() : 0));
  writer.write("factorised", entries);
  if (!waiting && cut_ && holdsFactor_) {  // of a body that was less cut than it is now
    writer.write(
        "factorised.outer",
        std::span<const int>(lower_.outerIndexPtr(), static_cast<std::size_t>(lower_.cols()) + 1));
    writer.write("factorised.inner", std::span<const int>(lower_.innerIndexPtr(), entries.size()));
  } else if (waiting && !restoredOuter_.empty()) {
    writer.write("factorised.outer", std::span<const int>(restoredOuter_));
    writer.write("factorised.inner", std::span<const int>(restoredInner_));
  }
}

void SparseLDLSolver::restore(StateReader& reader) {
  reset();
  if (cut_) analyzed_ = false;  // the cuts have been made again since the pattern was found
  int shiftedBefore = 0, made = 0;
  if (reader.read("shifted", shiftedBefore)) isShifted_ = shiftedBefore != 0;
  if (reader.read("factorizations", made)) factorizations.set(made);
  restored_.resize(reader.count<double>("factorised"));
  if (!reader.read("factorised", std::span(restored_))) restored_.clear();
  restoredOuter_.resize(reader.count<int>("factorised.outer"));
  restoredInner_.resize(reader.count<int>("factorised.inner"));
  const bool whole = reader.read("factorised.outer", std::span(restoredOuter_)) &&
                     reader.read("factorised.inner", std::span(restoredInner_)) &&
                     restoredInner_.size() == restored_.size();
  if (!whole) restoredOuter_.clear();
}

}  // namespace stroma
