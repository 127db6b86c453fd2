// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/rest_placement.h"

#include <Eigen/LU>
#include <algorithm>

namespace stroma {

double RestPlacement::reachOf(ConstVec3Span rest) {
  constexpr std::size_t samples = 50, neighbour = 8;
  std::vector<double> distances, each;
  for (std::size_t i = 0; i < rest.size(); i += 1 + rest.size() / samples) {
    each.clear();
    for (const Vec3& x : rest) each.push_back((x - rest[i]).squaredNorm());
    const auto at =
        each.begin() + static_cast<std::ptrdiff_t>(std::min(neighbour, each.size() - 1));
    std::ranges::nth_element(each, at);
    distances.push_back(std::sqrt(*at));
  }
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return 1.5 * *middle;
}

RestPlacement::RestPlacement(ConstVec3Span rest, double reach)
    : rest_(rest.begin(), rest.end()), reach_(reach), grid_(0.5 * reach) {
  for (std::size_t i = 0; i < rest_.size(); ++i) grid_.insert(static_cast<Index>(i), rest_[i]);
}

std::vector<Index> RestPlacement::around(const Vec3& at) const {
  std::vector<Index> found;
  const Vec3 box = Vec3::Constant(reach_);
  grid_.query(at - box, at + box, [&](Index i) {
    if ((rest_[static_cast<std::size_t>(i)] - at).squaredNorm() < reach_ * reach_)
      found.push_back(i);
  });
  std::ranges::sort(found);  // the order of cells with equal keys is nobody's business
  return found;
}

bool RestPlacement::fit(const Vec3& at, ConstVec3Span x, Vec3& image, Mat3& F) const {
  const std::vector<Index> found = around(at);
  if (found.empty()) return false;
  const auto weight = [&](Index i) {
    const double s =
        1 - (rest_[static_cast<std::size_t>(i)] - at).squaredNorm() / (reach_ * reach_);
    return s * s;
  };
  double sum = 0;
  Vec3 middle = Vec3::Zero(), moved = Vec3::Zero();
  for (const Index i : found) {
    const double w = weight(i);
    sum += w;
    middle += w * rest_[static_cast<std::size_t>(i)];
    moved += w * x[static_cast<std::size_t>(i)];
  }
  if (!(sum > 0)) return false;
  middle /= sum;
  moved /= sum;
  Mat3 A = Mat3::Zero(), B = Mat3::Zero();
  for (const Index i : found) {
    const double w = weight(i);
    const Vec3 r = rest_[static_cast<std::size_t>(i)] - middle;
    A += w * r * r.transpose();
    B += w * (x[static_cast<std::size_t>(i)] - moved) * r.transpose();
  }
  // directions that few particles span stay as they are
  constexpr double ridge = 1e-3;
  const double floor = ridge * std::max(A.trace(), 1e-6 * sum * reach_ * reach_);
  F = (B + floor * Mat3::Identity()) * (A + floor * Mat3::Identity()).inverse();
  constexpr double flattest = 0.1;  // a collapsed neighbourhood has no inverse worth following
  if (!(F.determinant() > flattest)) F.setIdentity();
  image = moved + F * (at - middle);
  return true;
}

std::optional<RestPlacement::Place> RestPlacement::find(const Vec3& point, const Vec3& guess,
                                                        ConstVec3Span x) const {
  constexpr int mostIterations = 20;
  constexpr double accuracy = 1e-4, least = 0.05;  // of the reach
  Vec3 at = guess, image;
  Mat3 F, inverse;
  double length = 0;
  for (int iteration = 0; iteration < mostIterations; ++iteration) {
    if (!fit(at, x, image, F)) return std::nullopt;
    inverse = F.inverse();
    Vec3 step = inverse * (point - image);
    length = step.norm();
    if (length > 0.5 * reach_) step *= 0.5 * reach_ / length;
    at += step;
    if (length < accuracy * reach_) break;
  }
  return length < least * reach_ ? std::optional(Place{at, inverse}) : std::nullopt;
}

}  // namespace stroma
