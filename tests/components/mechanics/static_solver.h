// SPDX-License-Identifier: Apache-2.0
// Equilibrium of a point-based body for the tests: Newton's method on assembled matrices with
// backtracking on the energy.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <functional>
#include <numeric>

#include "components/mechanics/mls_elasticity.h"

namespace stroma::test {

using SparseMatrix = Eigen::SparseMatrix<double>;

template <class Material>
SparseMatrix stiffnessMatrix(const MlsElasticity<Material>& elasticity, Index particles) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(particles) * 200 * 9);
  elasticity.assembleStiffness([&entries](Index a, Index b, const Mat3& block) {
    if (b > a) return;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (block(r, c) != 0) entries.emplace_back(3 * a + r, 3 * b + c, block(r, c));
  });
  SparseMatrix K(3 * particles, 3 * particles);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

// Supports and stiffness beyond the body: per degree of freedom a spring to a target position.
struct Springs {
  Eigen::VectorXd stiffness, target;  // N/m, m

  explicit Springs(ConstVec3Span X)
      : stiffness(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * X.size()))),
        target(flat(X)) {}
};

// Solves K u = f at rest; a tiny spring everywhere stands for missing supports, and is refined away
// in the deformation as long as the load is balanced.
template <class Material>
std::vector<Vec3> solveLinear(MlsElasticity<Material>& elasticity, ConstVec3Span X,
                              ConstVec3Span load, const Springs& springs) {
  elasticity.prepareTangent(X);
  SparseMatrix K = stiffnessMatrix(elasticity, static_cast<Index>(X.size()));
  const double tiny = 1e-9 * K.diagonal().maxCoeff();
  K += SparseMatrix(springs.stiffness.asDiagonal());
  SparseMatrix shifted = K;
  for (Eigen::Index d = 0; d < K.rows(); ++d) shifted.coeffRef(d, d) += tiny;
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factor(shifted);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(K.rows());
  const Eigen::VectorXd f = flat(load);
  const auto symmetric = K.template selfadjointView<Eigen::Lower>();
  for (int k = 0; k < 3; ++k) u += factor.solve(f - symmetric * u);
  std::vector<Vec3> out(X.size());
  flat(Vec3Span(out)) = u;
  return out;
}

// Cholesky factors of a long body's stiffness. Its particles are ordered along x, which makes the
// matrix a narrow band; slabs as wide as the band couple only with the next, by dense blocks.
class BandFactor {
 public:
  explicit BandFactor(ConstVec3Span X) {
    std::vector<Index> order(X.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [X](Index a, Index b) { return X[a].x() < X[b].x(); });
    place_.resize(3 * X.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      for (int c = 0; c < 3; ++c) place_[3 * order[k] + c] = static_cast<Eigen::Index>(3 * k) + c;
  }

  // The lower half of a symmetric matrix; false where it is not positive definite.
  [[nodiscard]] bool factorise(const SparseMatrix& lower) {
    const auto entries = [&lower](auto&& visit) {
      for (int k = 0; k < lower.outerSize(); ++k)
        for (SparseMatrix::InnerIterator it(lower, k); it; ++it)
          visit(it.row(), it.col(), it.value());
    };
    width_ = 1;
    entries([&](Eigen::Index r, Eigen::Index c, double) {
      width_ = std::max(width_, std::abs(place_[r] - place_[c]));
    });
    const auto size = static_cast<Eigen::Index>(place_.size());
    diagonal_.clear();
    below_.clear();
    for (Eigen::Index begin = 0; begin < size; begin += width_) {
      const Eigen::Index rows = std::min(width_, size - begin);
      diagonal_.emplace_back(Eigen::MatrixXd::Zero(rows, rows));
      if (begin > 0) below_.emplace_back(Eigen::MatrixXd::Zero(rows, width_));
    }
    entries([&](Eigen::Index r, Eigen::Index c, double value) {
      const auto [low, high] = std::minmax(place_[r], place_[c]);
      const Eigen::Index block = low / width_;
      auto& to = high / width_ == block ? diagonal_[block] : below_[block];
      to(high % width_, low % width_) = value;
    });
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
      Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(diagonal_[k]);
      if (factor.info() != Eigen::Success) return false;
      if (k + 1 == diagonal_.size()) break;
      factor.matrixL().adjoint().solveInPlace<Eigen::OnTheRight>(below_[k]);
      diagonal_[k + 1].selfadjointView<Eigen::Lower>().rankUpdate(below_[k], -1);
    }
    return true;
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    Eigen::VectorXd x(b.size());
    for (Eigen::Index d = 0; d < b.size(); ++d) x[place_[d]] = b[d];
    const auto slab = [&](std::size_t k) {
      return x.segment(static_cast<Eigen::Index>(k) * width_, diagonal_[k].rows());
    };
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
      if (k > 0) slab(k) -= below_[k - 1] * slab(k - 1);
      diagonal_[k].triangularView<Eigen::Lower>().solveInPlace(slab(k));
    }
    for (std::size_t k = diagonal_.size(); k-- > 0;) {
      if (k + 1 < diagonal_.size()) slab(k) -= below_[k].transpose() * slab(k + 1);
      diagonal_[k].triangularView<Eigen::Lower>().adjoint().solveInPlace(slab(k));
    }
    Eigen::VectorXd out(b.size());
    for (Eigen::Index d = 0; d < b.size(); ++d) out[d] = x[place_[d]];
    return out;
  }

 private:
  std::vector<Eigen::Index> place_;  // of every degree of freedom in the order along x
  Eigen::Index width_ = 0;
  std::vector<Eigen::MatrixXd> diagonal_, below_;
};

struct StaticProblem {
  // Adds external forces at x and returns minus their potential, 0 where it has none to compare.
  std::function<double(ConstVec3Span x, Vec3Span f)> load;
  const Springs* springs;
  ConstVec3Span reference;  // positions whose order along x keeps the matrix narrow
  double tolerance = 1e-9;  // residual over the size of the load
  int maxIterations = 60;
};

struct StaticResult {
  bool converged = false;
  int iterations = 0, factorizations = 0;
  double residual = 0;
};

// Newton from x, with the filtered tangent where the exact one is not positive; x ends at rest.
template <class Material>
StaticResult solveStatic(MlsElasticity<Material>& elasticity, Vec3Span x,
                         const StaticProblem& problem) {
  const auto count = static_cast<Index>(x.size());
  const auto& springs = *problem.springs;
  BandFactor factor{ConstVec3Span(problem.reference)};
  std::vector<Vec3> f(x.size());
  double loadSize = 0;
  const auto evaluate = [&](double& merit) {
    std::fill(f.begin(), f.end(), Vec3::Zero());
    const double work = problem.load(x, f);
    loadSize = std::max(flat(Vec3Span(f)).norm(), 1e-30);
    elasticity.addForces(x, f);
    const Eigen::VectorXd stretch = flat(ConstVec3Span(x)) - springs.target;
    flat(Vec3Span(f)) -= springs.stiffness.cwiseProduct(stretch);
    merit =
        elasticity.energy(x) + 0.5 * stretch.dot(springs.stiffness.cwiseProduct(stretch)) - work;
  };
  StaticResult result;
  double merit = 0;
  evaluate(merit);
  for (double last = 0; result.iterations < problem.maxIterations; ++result.iterations) {
    result.residual = flat(Vec3Span(f)).norm() / loadSize;
    if (result.residual < problem.tolerance) return result.converged = true, result;
    // a factor is kept while it serves
    if (!(result.residual < 0.3 * last)) {
      for (const auto definiteness : {TangentKind::exact, TangentKind::filtered}) {
        elasticity.prepareTangent(x, definiteness);
        SparseMatrix K = stiffnessMatrix(elasticity, count);
        K += SparseMatrix(springs.stiffness.asDiagonal());
        if (factor.factorise(K)) break;
      }
      ++result.factorizations;
    }
    const Eigen::VectorXd step = factor.solve(flat(Vec3Span(f)));
    const Eigen::VectorXd start = flat(ConstVec3Span(x)), downhill = flat(Vec3Span(f));
    const double before = merit, slope = downhill.dot(step);
    const double norm = downhill.norm();
    double length = 1;
    for (int k = 0; k < 25; ++k, length *= 0.5) {
      flat(x) = start + length * step;
      evaluate(merit);
      if (merit <= before - 1e-4 * length * slope || flat(Vec3Span(f)).norm() < 0.5 * norm) break;
    }
    last = norm / loadSize;
  }
  result.residual = flat(Vec3Span(f)).norm() / loadSize;
  return result;
}

}  // namespace stroma::test
