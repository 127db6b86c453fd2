// SPDX-License-Identifier: Apache-2.0
// All triangles that block links between particles, in the rest configuration. Questions are
// answered exactly; ties follow exact_predicates.h, so a link never slips through between two
// triangles that share an edge, and crosses(a, b) equals crosses(b, a).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "components/cutting/hash_grid.h"
#include "core/topology_change.h"

namespace stroma {

class CutFacets final : public CutBarrier {
 public:
  // `cell`: side of the search grid's cells [m], about the length of a link.
  explicit CutFacets(double cell);

  void add(std::span<const RestTriangle> facets);
  [[nodiscard]] Index count() const { return static_cast<Index>(facets_.size()); }
  [[nodiscard]] std::span<const RestTriangle> facets() const { return facets_; }

  [[nodiscard]] bool crosses(const Vec3& a, const Vec3& b) const { return crossesNew(a, b, 0); }
  void block(const Vec3& from, ConstVec3Span to, std::span<char> blocked) const override;
  // Whether a facet is no further than `reach` from the point [m].
  [[nodiscard]] bool near(const Vec3& point, double reach) const;
  // Only facets from number `mark` on (count() before they were added).
  [[nodiscard]] bool crossesNew(const Vec3& a, const Vec3& b, Index mark) const;
  // The same without the grid, for tests.
  [[nodiscard]] bool crossesBruteForce(const Vec3& a, const Vec3& b) const;

 private:
  struct Box {
    Vec3 low, high;
    // Boxes that only touch do: the tie rule decides about points on a facet.
    [[nodiscard]] bool meets(const Box& other) const {
      return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
             other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
    }
  };
  struct Plane {
    explicit Plane(const RestTriangle& t);
    // 0 where rounding could matter.
    [[nodiscard]] int clearSideOf(const Vec3& x) const;
    Vec3 origin, normal;
    double size;  // product of its two edges', for the rounding error
  };
  struct Near {
    Index facet;
    int side;  // where the segments begin, if clear
  };
  [[nodiscard]] std::vector<Near> meeting(const Box& box) const;
  [[nodiscard]] bool crossesOneOf(std::span<const Near> facets, const Vec3& a, const Vec3& b) const;
  [[nodiscard]] static int clearlyThrough(const Vec3& a, const Vec3& b, const RestTriangle& t);

  HashGrid grid_;
  std::vector<RestTriangle> facets_;
  std::vector<Box> boxes_;
  std::vector<Plane> planes_;
  Box all_{Vec3::Constant(std::numeric_limits<double>::infinity()),
           Vec3::Constant(-std::numeric_limits<double>::infinity())};
};

}  // namespace stroma
