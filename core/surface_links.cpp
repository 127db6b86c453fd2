// SPDX-License-Identifier: Apache-2.0
#include "core/surface_links.h"

#include <cmath>

namespace stroma {
namespace {

Vec3 unitNormal(const Triangle& t, ConstVec3Span x) {
  const Vec3 n = cornersOf(t, x).areaNormal();
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

double angleAt(const Triangle& t, Index corner, ConstVec3Span x) {
  const auto node = [&](Index k) -> const Vec3& {
    return x[static_cast<std::size_t>(t[static_cast<std::size_t>((corner + k) % 3)])];
  };
  const Vec3 u = node(1) - node(0), v = node(2) - node(0);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

void SurfaceLinks::build(std::span<const Triangle> triangles, Index nodeCount) {
  triangles_.assign(triangles.begin(), triangles.end());
  first_.assign(static_cast<std::size_t>(nodeCount), -1);
  next_.assign(3 * triangles_.size(), -1);
  // from the last to the first: each goes to the head of its list
  for (auto k = static_cast<Index>(next_.size()) - 1; k >= 0; --k) {
    if (!isGone(triangles_[static_cast<std::size_t>(k / 3)])) insert(k);
  }
}

void SurfaceLinks::change(Index triangle, const Triangle& nodes) {
  const auto t = static_cast<std::size_t>(triangle);
  if (t < triangles_.size()) {
    for (Index c = 0; c < 3; ++c) {
      if (!isGone(triangles_[t])) remove(3 * triangle + c);
    }
  } else {
    triangles_.resize(t + 1, Triangle{0, 0, 0});
    next_.resize(3 * (t + 1), -1);
  }
  triangles_[t] = nodes;
  if (isGone(nodes)) return;
  for (const Index node : nodes) {
    if (node >= nodeCount()) first_.resize(static_cast<std::size_t>(node) + 1, -1);
  }
  for (Index c = 0; c < 3; ++c) insert(3 * triangle + c);
}

void SurfaceLinks::insert(Index corner) {
  Index* at = &first_[static_cast<std::size_t>(nodeAt(corner))];
  while (*at >= 0 && *at < corner) at = &next_[static_cast<std::size_t>(*at)];
  next_[static_cast<std::size_t>(corner)] = *at;
  *at = corner;
}

void SurfaceLinks::remove(Index corner) {
  Index* at = &first_[static_cast<std::size_t>(nodeAt(corner))];
  while (*at >= 0 && *at != corner) at = &next_[static_cast<std::size_t>(*at)];
  if (*at == corner) *at = next_[static_cast<std::size_t>(corner)];
  next_[static_cast<std::size_t>(corner)] = -1;
}

Index SurfaceLinks::across(Index triangle, Index nodeA, Index nodeB) const {
  Index found = -1;
  forCorners(nodeA, [&](Index other, Index) {
    if (found >= 0 || other == triangle) return;
    const Triangle& t = triangles_[static_cast<std::size_t>(other)];
    if (t[0] == nodeB || t[1] == nodeB || t[2] == nodeB) found = other;
  });
  return found;
}

bool SurfaceLinks::closed() const {
  for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
    if (!closedRound(t)) return false;
  }
  return true;
}

bool SurfaceLinks::closedRound(Index triangle) const {
  const Triangle& nodes = triangles_[static_cast<std::size_t>(triangle)];
  if (isGone(nodes)) return true;
  for (std::size_t c = 0; c < 3; ++c) {
    const Index from = nodes[c], to = nodes[(c + 1) % 3];
    bool back = false;
    forCorners(to, [&](Index other, Index corner) {
      const Triangle& n = triangles_[static_cast<std::size_t>(other)];
      back = back || n[static_cast<std::size_t>((corner + 1) % 3)] == from;
    });
    if (!back) return false;
  }
  return true;
}

Vec3 SurfaceLinks::pseudonormal(Index triangle, const Vec3& weights, ConstVec3Span x) const {
  const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
  const Vec3 own = unitNormal(t, x);
  const auto zeros = (weights.array() == 0).count();
  if (zeros == 0) return own;
  if (zeros == 1) {
    const std::size_t opposite = weights[0] == 0 ? 0 : weights[1] == 0 ? 1 : 2;
    const Index other = across(triangle, t[(opposite + 1) % 3], t[(opposite + 2) % 3]);
    return other < 0 ? own : Vec3(own + unitNormal(triangles_[static_cast<std::size_t>(other)], x));
  }
  const std::size_t corner = weights[0] != 0 ? 0 : weights[1] != 0 ? 1 : 2;
  Vec3 sum = Vec3::Zero();
  forCorners(t[corner], [&](Index other, Index c) {
    const Triangle& n = triangles_[static_cast<std::size_t>(other)];
    sum += angleAt(n, c, x) * unitNormal(n, x);
  });
  return sum;
}

}  // namespace stroma
