// SPDX-License-Identifier: Apache-2.0
// Which points lie in boxes or balls, and which elements go with them. Lengths in metres; borders
// belong to the region.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/value.h"

namespace stroma {

// Three corners and a depth: p0, p1, p2 span the middle face (p0-p1 and p1-p2 its edges), the box
// reaches depth / 2 to both sides of it. Edges need not be orthogonal in p1: the second is made so.
struct OrientedBox {
  Vec3 corner;  // p0
  Mat3 axes;    // unit edges, as rows
  Vec3 size;    // along the axes
};

struct Ball {
  Vec3 center;
  double radius;
};

[[nodiscard]] bool contains(const Box& box, const Vec3& point);
[[nodiscard]] bool contains(const OrientedBox& box, const Vec3& point);
[[nodiscard]] bool contains(const Ball& ball, const Vec3& point);

// From ten numbers: p0, p1, p2, depth. The sizes are zero where the points lie on a line.
[[nodiscard]] OrientedBox orientedBox(std::span<const double, 10> numbers);

// Indices, ascending, of the points for which `isIn` holds.
template <class Predicate>
[[nodiscard]] std::vector<Index> indicesWhere(ConstVec3Span points, Predicate&& isIn) {
  std::vector<Index> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (isIn(points[i])) found.push_back(static_cast<Index>(i));
  }
  return found;
}

// Indices of the elements that have all their nodes among the ascending `nodes` (strict), or at
// least one of them (not strict).
template <std::size_t N>
[[nodiscard]] std::vector<Index> elementsOf(std::span<const Index> nodes,
                                            std::span<const std::array<Index, N>> elements,
                                            bool strict) {
  const auto isIn = [&](Index node) { return std::ranges::binary_search(nodes, node); };
  std::vector<Index> found;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (strict ? std::ranges::all_of(elements[e], isIn) : std::ranges::any_of(elements[e], isIn)) {
      found.push_back(static_cast<Index>(e));
    }
  }
  return found;
}

}  // namespace stroma
