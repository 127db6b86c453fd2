// SPDX-License-Identifier: Apache-2.0
// When a moving point goes through a moving triangle.
#pragma once

#include <optional>

#include "core/triangle.h"

namespace stroma {

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
