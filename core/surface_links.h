// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/triangle.h"

namespace stroma {

// Which triangles meet at a node, kept as one list of corners a node that is always in ascending
// order, so that sums over it have the same bits however the surface came about. Changes cost in
// proportion to themselves.
class SurfaceLinks {
 public:
  // Triangles are gone when their nodes are equal; negative nodes do not occur.
  void build(std::span<const Triangle> triangles, Index nodeCount);
  // The triangle's nodes are now others, or it is new and the last one.
  void change(Index triangle, const Triangle& nodes);

  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] Index nodeCount() const { return static_cast<Index>(first_.size()); }

  // Calls visit(triangle, corner) for all corners at a node, ascending.
  template <class Visit>
  void forCorners(Index node, Visit&& visit) const {
    for (Index k = first_[static_cast<std::size_t>(node)]; k >= 0;
         k = next_[static_cast<std::size_t>(k)]) {
      visit(k / 3, k % 3);
    }
  }
  [[nodiscard]] bool hasCorner(Index node) const {
    return first_[static_cast<std::size_t>(node)] >= 0;
  }
  // Another triangle with the edge, the one with the lowest number; -1 on a rim.
  [[nodiscard]] Index across(Index triangle, Index nodeA, Index nodeB) const;
  // Whether every edge has a second triangle that runs along it the other way.
  [[nodiscard]] bool closed() const;
  // The same for the edges of one triangle.
  [[nodiscard]] bool closedRound(Index triangle) const;

  // Outward direction at a point of a triangle that decides on which side of the surface its
  // neighbourhood is: the normal inside the triangle, the sum of the two on an edge, and that of
  // all weighted by their angles at a node (Baerentzen and Aanaes 2005). Not normalised.
  [[nodiscard]] Vec3 pseudonormal(Index triangle, const Vec3& weights, ConstVec3Span x) const;

 private:
  void insert(Index corner);
  void remove(Index corner);
  [[nodiscard]] Index nodeAt(Index corner) const {
    return triangles_[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)];
  }
  std::vector<Triangle> triangles_;
  std::vector<Index> first_;  // corner of each node, -1 for none
  std::vector<Index> next_;   // of each corner (3 x triangle + corner), -1 at the end
};

[[nodiscard]] inline bool isGone(const Triangle& t) { return t[0] == t[1] && t[1] == t[2]; }

}  // namespace stroma
