// SPDX-License-Identifier: Apache-2.0
#include "components/stability/body_measures.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace stroma {
namespace {

const Vec3& at(ConstVec3Span x, Index i) { return x[static_cast<std::size_t>(i)]; }

Vec3 mean(ConstVec3Span x) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : x) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(x.size(), 1));
}

// Of the corner `a` with the edges to the three others.
double signedVolume(ConstVec3Span x, Index a, Index b, Index c, Index d) {
  return (at(x, b) - at(x, a)).cross(at(x, c) - at(x, a)).dot(at(x, d) - at(x, a));
}

bool turned(ConstVec3Span x, ConstVec3Span rest, Index a, Index b, Index c, Index d) {
  const double before = signedVolume(rest, a, b, c, d), now = signedVolume(x, a, b, c, d);
  return !(before * now > 0);
}

}  // namespace

double longestSide(ConstVec3Span points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

double largestDisplacement(ConstVec3Span x, ConstVec3Span rest) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, (x[i] - rest[i]).norm());
  }
  return largest;
}

double largestShapeError(ConstVec3Span x, ConstVec3Span rest) {
  const Vec3 middle = mean(x), restMiddle = mean(rest);
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += (x[i] - middle) * (rest[i] - restMiddle).transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) {
    const Vec3 signs(1, 1, -1);
    turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 fitted = middle + turn * (rest[i] - restMiddle);
    largest = std::max(largest, (x[i] - fitted).norm());
  }
  return largest;
}

void addMomenta(ConstVec3Span x, ConstVec3Span v, std::span<const double> mass, const Vec3& about,
                Momenta& sum) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 linear = mass[i] * v[i], arm = x[i] - about;
    sum.linear += linear;
    sum.linearScale += linear.norm();
    sum.angular += arm.cross(linear);
    sum.angularScale += arm.norm() * linear.norm();
  }
}

std::size_t countInverted(std::span<const Tetrahedron> elements, ConstVec3Span x,
                          ConstVec3Span rest) {
  return static_cast<std::size_t>(std::ranges::count_if(
      elements, [&](const Tetrahedron& t) { return turned(x, rest, t[0], t[1], t[2], t[3]); }));
}

std::size_t countInverted(std::span<const Hexahedron> elements, ConstVec3Span x,
                          ConstVec3Span rest) {
  // the three neighbours of every corner
  constexpr std::array<std::array<std::size_t, 3>, 8> next{
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
  return static_cast<std::size_t>(std::ranges::count_if(elements, [&](const Hexahedron& h) {
    for (std::size_t c = 0; c < 8; ++c) {
      if (turned(x, rest, h[c], h[next[c][0]], h[next[c][1]], h[next[c][2]])) return true;
    }
    return false;
  }));
}

double shareOf(ConstVec3Span pattern, ConstVec3Span x, ConstVec3Span rest) {
  double along = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    along += pattern[i].dot(x[i] - rest[i]);
    size += pattern[i].squaredNorm();
  }
  return size > 0 ? along / size : 0;
}

}  // namespace stroma
