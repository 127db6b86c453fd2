// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/second_order.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace stroma {
namespace {

constexpr double oneSided = 0.3;     // mean of the weighted offsets over their mean length
constexpr double ridge = 0.03;       // of the trace of the linear moments; 0.01 bends 1 % stiffer
                                     // and costs a tenth of the stable step
constexpr double farthest = 1.4;     // spacings to a row's last neighbour, about
constexpr double leastShare = 0.25;  // of its volume that a particle's weight keeps
constexpr int attempts = 8;

using Basis = Eigen::Matrix<double, 9, 1>;

bool isOneSided(ConstVec3Span X, const Neighbourhoods& n, Index i) {
  Vec3 mean = Vec3::Zero();
  double length = 0;
  const auto neighbours = n.neighboursOf(i);
  const auto weights = n.weightsOf(i);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec3 offset = X[neighbours[k]] - X[i];
    mean += weights[k] * offset;
    length += weights[k] * offset.norm();
  }
  return mean.norm() > oneSided * length;
}

void refitRow(ConstVec3Span X, const Neighbourhoods& n, Index i, Gradients& gradients) {
  const auto neighbours = n.neighboursOf(i);
  const auto weights = n.weightsOf(i);
  double reach = 0;
  for (const Index j : neighbours) reach = std::max(reach, (X[j] - X[i]).norm());
  const double scale = farthest / reach;
  const auto basis = [&](Index j) {
    const Vec3 y = scale * (X[j] - X[i]);
    Basis p;
    p << y.x(), y.y(), y.z(), 0.5 * y.x() * y.x(), 0.5 * y.y() * y.y(), 0.5 * y.z() * y.z(),
        y.x() * y.y(), y.y() * y.z(), y.z() * y.x();
    return p;
  };
  Eigen::Matrix<double, 9, 9> M = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Basis p = basis(neighbours[k]);
    M += weights[k] * p * p.transpose();
  }
  M.diagonal().tail<6>().array() += ridge * M.diagonal().head<3>().sum();
  const Eigen::LDLT<Eigen::Matrix<double, 9, 9>> factor(M);
  const auto first = static_cast<std::size_t>(n.rows[i].begin);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Basis c = factor.solve(basis(neighbours[k]));
    gradients.values[first + k] = scale * weights[k] * c.head<3>();
  }
}

// Where row i samples the gradient, relative to X_i: of u = x_a x_b it gives sum_j g_a x_a x_b for
// d u / d x_a (a != b), and twice its half for a = b, averaged over the derivatives a.
Vec3 samplingOffset(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients, Index i) {
  Vec3 offset = Vec3::Zero();
  for (Index s = n.rows[i].begin; s < n.rows[i].begin + n.rows[i].size; ++s) {
    const Vec3 x = X[n.neighbours[s]] - X[i], gx = gradients.values[s].cwiseProduct(x);
    offset += (gx.sum() * x - 0.5 * gx.cwiseProduct(x)) / 3;
  }
  return offset;
}

}  // namespace

void refitOneSided(ConstVec3Span X, const Neighbourhoods& n, Gradients& gradients) {
  parallelFor(n.particleCount(), [&](Index i) {
    if (gradients.rank[i] == 3 && isOneSided(X, n, i)) refitRow(X, n, i, gradients);
  });
}

std::vector<double> quadratureWeights(ConstVec3Span X, const Neighbourhoods& n,
                                      const TransposedRows& transposed, const Gradients& gradients,
                                      std::span<const double> V) {
  std::vector<Vec3> moment(X.size());  // V_i d_i
  parallelFor(n.particleCount(), [&](Index i) {
    moment[i] = gradients.rank[i] == 3 ? Vec3(V[i] * samplingOffset(X, n, gradients, i))
                                       : Vec3(Vec3::Zero());
  });
  std::vector<double> weights(V.size());
  std::vector<char> low(V.size());
  for (int attempt = 0;; ++attempt) {
    parallelFor(n.particleCount(), [&](Index j) {
      double sum = V[j];
      for (Index s = n.rows[j].begin; s < n.rows[j].begin + n.rows[j].size; ++s)
        sum += moment[j].dot(gradients.values[s]);
      for (const BackLink& link : transposed.linksOf(j))
        sum -= moment[link.particle].dot(gradients.values[link.slot]);
      weights[j] = sum;
      low[j] = sum < leastShare * V[j];
    });
    if (std::ranges::find(low, 1) == low.end()) return weights;
    if (attempt == attempts) return {};
    // halve the moments that bear on a particle with too little
    parallelFor(n.particleCount(), [&](Index i) {
      const auto touches = std::ranges::any_of(n.neighboursOf(i), [&](Index j) { return low[j]; });
      if (low[i] || touches) moment[i] *= 0.5;
    });
  }
}

}  // namespace stroma
