// SPDX-License-Identifier: Apache-2.0
// How a blade lies in a body, in the rest configuration: how much of its edge is inside, and where
// it goes through the outer surface. The outer surface is the one before any cut; cuts do not move
// it. Exact predicates decide what crosses what.
#pragma once

#include <optional>

#include "components/cutting/hash_grid.h"
#include "core/topology_change.h"

namespace stroma {

class BladeCourse {
 public:
  // `closed`: the surface encloses the body; else it is an open sheet, and what lies beyond it
  // along the edge counts as inside.
  BladeCourse(std::vector<RestTriangle> surface, bool closed);

  // From where to where along an edge the body reaches.
  struct Extent {
    double length = 0;               // of the edge [m]
    double firstAt = 0, lastAt = 0;  // first and last crossing of the surface, along the edge [m]
    bool beginsInside = false, endsInside = false;
  };
  struct Course : Extent {
    double inside = 0;                // length of the edge inside the body [m]
    std::optional<Vec3> first, last;  // where those crossings are
    [[nodiscard]] bool engaged() const { return inside > 0; }
  };
  // `edge`: polyline from heel to tip. One that closes on itself is a ring.
  [[nodiscard]] Course of(ConstVec3Span edge) const;
  // The part of an edge that `extent` has in the body, and `margin` (m) more to both sides; empty
  // where this edge is too short to come so far.
  [[nodiscard]] static std::vector<Vec3> partNear(ConstVec3Span edge, const Extent& extent,
                                                  double margin);
  [[nodiscard]] bool contains(const Vec3& point) const;

 private:
  void crossings(const Vec3& p, const Vec3& q, std::vector<double>& along) const;

  std::vector<RestTriangle> surface_;
  bool closed_;
  HashGrid grid_;
  Vec3 low_, high_;
};

}  // namespace stroma
