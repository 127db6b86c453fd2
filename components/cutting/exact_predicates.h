// SPDX-License-Identifier: Apache-2.0
// Exact answers about points with double coordinates, for everything in cutting that decides on
// which side something lies. The signs come from CGAL's filtered exact kernel (Shewchuk 1997 in
// spirit: floating point first, exact arithmetic when the filter cannot tell).
//
// Ties have one rule: both end points of a segment count as moved by the same vector (d, d^2, d^3),
// d > 0 infinitely small (simulation of simplicity, Edelsbrunner and Muecke 1990, for a rigid
// shift). As all segments are moved alike and no triangle moves, the answers are those of a real
// configuration without ties: a segment never slips between two triangles that share an edge, a
// point on a triangle belongs to one of its sides for every segment that ends there, and neither
// the order of a segment's ends nor that of a triangle's corners matters.
#pragma once

#include "core/types.h"

namespace stroma {

// Sign of det(b - a, c - a, d - a): +1, 0 or -1, exact.
[[nodiscard]] int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// The same with d moved as described above; 0 only if a, b, c lie on a line.
[[nodiscard]] int sideOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Does the segment pq cross triangle abc? Never true for a triangle without area.
[[nodiscard]] bool segmentCrossesTriangle(const Vec3& p, const Vec3& q, const Vec3& a,
                                          const Vec3& b, const Vec3& c);

}  // namespace stroma
