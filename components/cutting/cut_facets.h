// SPDX-License-Identifier: Apache-2.0
// All triangles that block links between particles, in the rest configuration. Questions are
// answered exactly; ties follow exact_predicates.h, so a link never slips through between two
// triangles that share an edge, and crosses(a, b) equals crosses(b, a).
#pragma once

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
  // Only facets from number `mark` on (count() before they were added).
  [[nodiscard]] bool crossesNew(const Vec3& a, const Vec3& b, Index mark) const;
  // The same without the grid, for tests.
  [[nodiscard]] bool crossesBruteForce(const Vec3& a, const Vec3& b) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  HashGrid grid_;
  std::vector<RestTriangle> facets_;
  std::vector<Box> boxes_;
};

}  // namespace stroma
