// SPDX-License-Identifier: Apache-2.0
// One triangle: its normal, and the point of it that is nearest to another point. Many: the volume
// that they enclose.
#pragma once

#include <span>

#include "core/types.h"

namespace stroma {

struct Corners {
  Vec3 a, b, c;
  [[nodiscard]] Vec3 at(const Vec3& weights) const {
    return weights[0] * a + weights[1] * b + weights[2] * c;
  }
  // Normal times twice the area.
  [[nodiscard]] Vec3 areaNormal() const { return (b - a).cross(c - a); }
};

[[nodiscard]] inline Corners cornersOf(const Triangle& t, ConstVec3Span x) {
  return {x[static_cast<std::size_t>(t[0])], x[static_cast<std::size_t>(t[1])],
          x[static_cast<std::size_t>(t[2])]};
}

struct TrianglePoint {
  Vec3 weights = Vec3::Zero();  // barycentric; an exact 0 where the point is on the opposite side
  Vec3 point = Vec3::Zero();
  double distance2 = 0;
};

// The point of the triangle nearest to p, by the seven regions round it (Ericson 2004, 5.1.5).
[[nodiscard]] TrianglePoint nearestOnTriangle(const Corners& t, const Vec3& p);

// Volume inside a closed surface (m^3), by the divergence theorem; negative when turned inside out.
[[nodiscard]] double enclosedVolume(ConstVec3Span positions, std::span<const Triangle> triangles);

}  // namespace stroma
