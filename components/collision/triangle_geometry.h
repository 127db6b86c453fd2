// SPDX-License-Identifier: Apache-2.0
// One triangle: the point nearest to another point, and when a moving point goes through it.
#pragma once

#include <optional>

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

struct Crossing {
  double time = 0;              // in [0, 1]
  Vec3 weights = Vec3::Zero();  // where in the triangle
};

// The first time at which the point, moving straight from p0 to p1 while the corners move straight
// from t0 to t1, goes through the triangle from its front (where the normal points) to its back.
// The point is in the triangle's plane at the roots of a cubic (Provot 1997), found between its
// extrema. Triangles reach `tolerance` (of their size) beyond their edges, so that nothing
// slips between neighbours through rounding.
[[nodiscard]] std::optional<Crossing> firstEntry(const Vec3& p0, const Vec3& p1, const Corners& t0,
                                                 const Corners& t1, double tolerance = 1e-9);

}  // namespace stroma
