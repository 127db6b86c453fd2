// SPDX-License-Identifier: Apache-2.0
#include "tools/study/field_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stroma::study {
namespace {

constexpr std::size_t neighbours = 24;
constexpr int terms = 10;
// A column of which less than this is left, after the earlier ones are taken out, says nothing new.
constexpr double negligible = 1e-6;

Eigen::Matrix<double, 1, terms> basis(const Vec3& r) {
  Eigen::Matrix<double, 1, terms> p;
  p << 1, r.x(), r.y(), r.z(), r.x() * r.x(), r.y() * r.y(), r.z() * r.z(), r.x() * r.y(),
      r.y() * r.z(), r.z() * r.x();
  return p;
}

// The fit at one point, where of all terms only the constant is not zero. The columns are made
// orthogonal one after the other, low orders first: so it is the higher of two terms which the
// nodes cannot tell apart that is left out.
Vec3 fitAt(const Vec3& point, ConstVec3Span X, ConstVec3Span u, std::span<const Index> near,
           double radius) {
  const auto n = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd Q(n, terms);
  Eigen::MatrixX3d values(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto node = static_cast<std::size_t>(near[static_cast<std::size_t>(k)]);
    const Vec3 r = (X[node] - point) / radius;
    const double weight = std::max(1 - r.squaredNorm(), 0.0) + 1e-3;
    Q.row(k) = weight * basis(r);
    values.row(k) = weight * u[node].transpose();
  }
  Eigen::Matrix<double, terms, terms> R = Eigen::Matrix<double, terms, terms>::Zero();
  std::array<bool, terms> used{};
  for (int c = 0; c < terms; ++c) {
    const double before = Q.col(c).norm();
    for (int pass = 0; pass < 2; ++pass) {  // twice: orthogonal to rounding
      for (int e = 0; e < c; ++e) {
        if (!used[static_cast<std::size_t>(e)]) continue;
        const double share = Q.col(e).dot(Q.col(c));
        R(e, c) += share;
        Q.col(c) -= share * Q.col(e);
      }
    }
    R(c, c) = Q.col(c).norm();
    used[static_cast<std::size_t>(c)] = R(c, c) > negligible * before && before > 0;
    if (used[static_cast<std::size_t>(c)]) Q.col(c) /= R(c, c);
  }
  // back substitution over the terms that are used; the last one found is the constant
  Eigen::Matrix<double, terms, 3> coefficients = Eigen::Matrix<double, terms, 3>::Zero();
  for (int c = terms - 1; c >= 0; --c) {
    if (!used[static_cast<std::size_t>(c)]) continue;
    Eigen::RowVector3d sum = Q.col(c).transpose() * values;
    for (int e = c + 1; e < terms; ++e) sum -= R(c, e) * coefficients.row(e);
    coefficients.row(c) = sum / R(c, c);
  }
  return coefficients.row(0).transpose();
}

}  // namespace

std::vector<Vec3> fitField(ConstVec3Span nodes, ConstVec3Span displacements, ConstVec3Span points) {
  std::vector<Vec3> field;
  std::vector<Index> order(nodes.size());
  const std::size_t count = std::min(neighbours, nodes.size());
  for (const Vec3& point : points) {
    if (count == 0) break;
    const auto distance2 = [&](Index node) {
      return (nodes[static_cast<std::size_t>(node)] - point).squaredNorm();
    };
    std::iota(order.begin(), order.end(), 0);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::ranges::nth_element(order, last, [&](Index a, Index b) {
      const double da = distance2(a), db = distance2(b);
      return da != db ? da < db : a < b;  // the same nodes, whatever the library does with ties
    });
    const std::span<Index> near(order.data(), count);
    std::ranges::sort(near);
    double farthest2 = std::numeric_limits<double>::min();
    for (const Index node : near) farthest2 = std::max(farthest2, distance2(node));
    field.push_back(fitAt(point, nodes, displacements, near, 1.1 * std::sqrt(farthest2)));
  }
  return field;
}

}  // namespace stroma::study
