// SPDX-License-Identifier: Apache-2.0
// Who sees whom once a body is cut. Links between particles, and between surface points and the
// particles that carry them, end at cuts (the visibility criterion of Belytschko, Lu, Gu 1994);
// what a cut takes away is replaced by the nearest others that can be seen, up to 2.5 support radii
// away. Rest positions (m); distances in the supports' own metric.
#pragma once

#include <utility>

#include "components/mechanics/gradients.h"
#include "components/mechanics/point_tree.h"
#include "components/mechanics/surface_shape.h"
#include "core/topology_change.h"

namespace stroma {

// A row or a point with fewer belongs to a chip that came free, unless it had no more before.
inline constexpr Index fewestLinks = 8;
// Remembers for many items which of them have been seen since the last clear(), at no cost for the
// others.
class Marks {
 public:
  void clear(std::size_t count) {
    last_.resize(count, 0);
    ++now_;
  }
  // Whether this is the first time.
  [[nodiscard]] bool mark(Index i) {
    std::uint64_t& last = last_[static_cast<std::size_t>(i)];
    return std::exchange(last, now_) != now_;
  }

 private:
  std::vector<std::uint64_t> last_;
  std::uint64_t now_ = 0;
};

// Which segments may cross one of a few facets, by their boxes: what a change has not touched need
// not be asked about.
class FacetBoxes {
 public:
  explicit FacetBoxes(std::span<const RestTriangle> facets);
  [[nodiscard]] bool mayCross(const Vec3& a, const Vec3& b) const;

 private:
  std::vector<Eigen::AlignedBox3d> boxes_;  // ascending along the axis
  Eigen::AlignedBox3d all_;
  Eigen::Index axis_ = 0;
  double longest_ = 0;  // box along the axis
};

// Whether a new facet lies between the eye and one of the particles.
[[nodiscard]] bool losesSight(const Vec3& eye, std::span<const Index> of, ConstVec3Span positions,
                              const FacetBoxes& facets, const CutBarrier& barrier);

class VisibilitySearch {
 public:
  // The positions must outlive this object; the neighbourhoods are those of the uncut body.
  VisibilitySearch(ConstVec3Span positions, const Neighbourhoods& neighbourhoods);

  // Particles no further than `reach` (m) from a sphere around one of the facets, each once.
  [[nodiscard]] std::vector<Index> around(std::span<const RestTriangle> facets, double reach) const;
  // Rows with a link that is blocked, among those that reach a new facet; ascending.
  [[nodiscard]] std::vector<Index> blockedRows(const Neighbourhoods& neighbourhoods,
                                               std::span<const RestTriangle> facets,
                                               const FacetBoxes& boxes,
                                               const CutBarrier& barrier) const;
  // Replaces row i by what it can see: with supports by count the `fewest` nearest, by radius
  // whatever lies within it, and if fewer the `fewest` nearest.
  void relink(Neighbourhoods& neighbourhoods, Index i, Index fewest, const CutBarrier& barrier);
  // The nearest particles of full rank that can be seen from `eye`, a place beside the point, at
  // most `supports` of them; where there is none any particle that can be seen. May be empty.
  [[nodiscard]] std::vector<Carrier> carriersOf(const Vec3& point, const Vec3& eye, Index supports,
                                                const Neighbourhoods& neighbourhoods,
                                                std::span<const std::uint8_t> rank,
                                                const CutBarrier& barrier) const;
  // These particles as carriers of the point, nearest first.
  [[nodiscard]] static std::vector<Carrier> sorted(const Vec3& point, std::span<const Index> which,
                                                   ConstVec3Span positions,
                                                   const Neighbourhoods& neighbourhoods);
  // The nearest particle, whether it can be seen or not.
  [[nodiscard]] Carrier nearest(const Vec3& point) const;

 private:
  struct Seen {
    double distance;
    Index id;
    bool operator<(const Seen& other) const {
      return distance < other.distance || (distance == other.distance && id < other.id);
    }
  };
  // The `count` nearest to the centre that the eye sees; with wholeBall all within the radius if
  // these are more.
  struct Wanted {
    const Vec3 &centre, &eye;
    double radius, extent;  // in the metric; Euclidean length of one unit of it
    std::size_t count;
    bool wholeBall;
  };
  template <class Distance>
  [[nodiscard]] std::vector<Seen> nearestSeen(const Wanted& wanted, const CutBarrier& barrier,
                                              Distance&& distance) const;

  ConstVec3Span X_;
  PointTree tree_;
  std::vector<double> radius_;  // of the uncut supports, in their own metric
  std::vector<double> reach_;   // m, to the last neighbour
  double usualReach_ = 0;       // rows that reach further are in long_
  std::vector<Index> long_;
  mutable Marks marks_;
};

}  // namespace stroma
