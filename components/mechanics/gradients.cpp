// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/gradients.h"

#include <Eigen/LU>
#include <algorithm>

#include "components/material/symmetric_eigen.h"

namespace stroma {
namespace {

constexpr double tauWiden = 0.003;

// A of the support's metric; only ratios between directions matter here.
Mat3 metricOf(const Neighbourhoods& n, Index i) {
  if (n.axes.empty()) return Mat3::Identity();
  const EllipsoidAxes& a = n.axes[i];
  return Mat3::Identity() + (a.tangential / a.across - 1) * a.normal * a.normal.transpose();
}

struct WidenedRow {
  Index particle;
  double radius;
  std::vector<Index> neighbours;
  std::vector<double> weights;
};

// Row i with the neighbours of its neighbours, the support grown to reach them.
WidenedRow widenedRow(ConstVec3Span X, const Neighbourhoods& n, Index i) {
  std::vector<Index> ids(n.neighboursOf(i).begin(), n.neighboursOf(i).end());
  for (const Index j : n.neighboursOf(i))
    ids.insert(ids.end(), n.neighboursOf(j).begin(), n.neighboursOf(j).end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::erase(ids, i);
  std::vector<std::pair<double, Index>> byDistance;
  for (const Index j : ids) byDistance.emplace_back(n.distance(i, X[j] - X[i]), j);
  std::sort(byDistance.begin(), byDistance.end());
  WidenedRow row{i, std::max(n.options.reach, 1.01) * byDistance.back().first, {}, {}};
  for (const auto& [distance, j] : byDistance) {
    row.neighbours.push_back(j);
    row.weights.push_back(kernelWeight(n.options.kernel, distance / row.radius));
  }
  return row;
}

// Inverse on the good directions of M; those below tauWiden of the trace are missing.
Mat3 partialInverse(const Mat3& M, DeficientParticle& particle) {
  const SymmetricEigen<3> eigen = symmetricEigen<3>(M);
  const double smallest = tauWiden * M.trace();
  Mat3 inverse = Mat3::Zero();
  particle.rank = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = eigen.vectors.col(2 - k);
    const double value = eigen.values[2 - k];
    particle.axes.col(k) = axis;
    if (!(value > smallest)) continue;
    inverse += axis * axis.transpose() / value;
    ++particle.rank;
  }
  return inverse;
}

Mat3 halfTurn(const Vec3& axis) { return 2 * axis * axis.transpose() - Mat3::Identity(); }

// Turns the unit vector t onto the direction of a; the identity where a vanishes.
Mat3 smallestRotation(const Vec3& t, const Vec3& a) {
  if (!(a.squaredNorm() > 0)) return Mat3::Identity();
  const Vec3 b = a.normalized(), half = t + b;
  // two half turns make the turn from t to b; where b = -t any axis across serves
  if (half.squaredNorm() > 1e-24) return halfTurn(half.normalized()) * halfTurn(t);
  const Vec3 n = t.unitOrthogonal();
  return halfTurn(n);
}

}  // namespace

double fitRow(ConstVec3Span X, const Neighbourhoods& n, Index i, Gradients& gradients) {
  const Mat3 A = metricOf(n, i);
  const auto neighbours = n.neighboursOf(i);
  const auto weights = n.weightsOf(i);
  Mat3 M = Mat3::Zero();
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec3 Y = A * (X[neighbours[k]] - X[i]);
    M += weights[k] * Y * Y.transpose();
  }

  // det M bounds the smallest eigenvalue from below and spares most particles the eigenproblem
  const double trace = M.trace();
  double tau = trace > 0 ? 4 * M.determinant() / (trace * trace * trace) : 0;
  if (tau < soundTau && trace > 0) tau = symmetricEigen<3>(M).values[0] / trace;

  std::erase_if(gradients.deficient, [i](const auto& d) { return d.particle == i; });
  Mat3 inverse;
  if (tau >= tauWiden) {
    inverse = A * M.inverse() * A;
    gradients.rank[i] = 3;
  } else {
    const Mat3 back = A.inverse();
    DeficientParticle particle{i, 0, Mat3::Identity()};
    inverse = trace > 0 ? partialInverse(back * M * back, particle) : Mat3::Zero();
    gradients.rank[i] = static_cast<std::uint8_t>(particle.rank);
    if (particle.rank < 3) gradients.deficient.push_back(particle);
  }
  const auto first = static_cast<std::size_t>(n.rows[i].begin);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    gradients.values[first + k] = weights[k] * inverse * (X[neighbours[k]] - X[i]);
  return tau;
}

Gradients computeGradients(ConstVec3Span X, Neighbourhoods& n) {
  Gradients g;
  g.values.assign(n.neighbours.size(), Vec3::Zero());
  g.rank.assign(X.size(), 0);
  std::vector<WidenedRow> thin;
  for (Index i = 0; i < n.particleCount(); ++i) {
    const double tau = fitRow(X, n, i, g);
    if (tau >= tauWiden && tau < soundTau) thin.push_back(widenedRow(X, n, i));
  }
  // only now, so that no widened row feeds another
  for (const WidenedRow& row : thin) {
    n.assignRow(row.particle, row.neighbours, row.weights);
    n.radii[row.particle] = row.radius;
    g.values.resize(n.neighbours.size(), Vec3::Zero());
    fitRow(X, n, row.particle, g);
  }
  std::sort(g.deficient.begin(), g.deficient.end(),
            [](const auto& a, const auto& b) { return a.particle < b.particle; });
  g.report.widened = static_cast<Index>(thin.size());
  for (const std::uint8_t rank : g.rank) {
    g.report.full += rank == 3;
    g.report.coplanar += rank == 2;
    g.report.colinear += rank == 1;
    g.report.isolated += rank == 0;
  }
  return g;
}

Mat3 completeGradient(const DeficientParticle& particle, const Mat3& F) {
  const Mat3& Q = particle.axes;
  if (particle.rank == 2) {
    const Vec3 N = Q.col(0).cross(Q.col(1));
    const Vec3 n = (F * Q.col(0)).cross(F * Q.col(1)).normalized();
    return F + (n - F * N) * N.transpose();
  }
  if (particle.rank == 1) {
    const Vec3 t = Q.col(0), a = F * t;
    const Mat3 R = smallestRotation(t, a);
    return R + (a - R * t) * t.transpose();
  }
  return Mat3::Identity();
}

Mat3 completeDerivative(const DeficientParticle& particle, const Mat3& F, const Mat3& dF) {
  const Mat3& Q = particle.axes;
  if (particle.rank == 2) {
    // the normal stays orthogonal to the deformed plane
    const Vec3 N = Q.col(0).cross(Q.col(1));
    const Mat3 good = dF - dF * N * N.transpose();
    const Vec3 dn = -F.inverse().transpose() * (good.transpose() * (F * N));
    return good + dn * N.transpose();
  }
  if (particle.rank == 1) {
    // everything across turns with the line; its twist does not matter to an isotropic law
    const Vec3 t = Q.col(0), a = F * t, da = dF * t;
    const Vec3 turn = a.cross(da) / std::max(a.squaredNorm(), 1e-300);
    Mat3 dR;
    for (int k = 0; k < 3; ++k) dR.col(k) = turn.cross(F.col(k));
    return dR + (da - dR * t) * t.transpose();
  }
  return Mat3::Zero();
}

}  // namespace stroma
