// SPDX-License-Identifier: Apache-2.0
#include "components/topology/region_of_interest.h"

#include "components/topology/element_check.h"

namespace stroma {

ConstVec3Span RegionOfInterest::points() const {
  if (position.isSet()) return *position;
  if (mechanicalState) return mechanicalState->rest();
  return topology ? topology->positions() : ConstVec3Span{};
}

void RegionOfInterest::bind() {
  if (!prepare()) return;
  const ConstVec3Span from = points();
  if (from.empty()) {
    error("roi-points", "has no points to choose from: give 'position' or put it below a state");
    return;
  }
  std::vector<Index> inside = indicesWhere(from, [&](const Vec3& x) { return isInside(x); });
  if (inside.empty()) {
    warning("roi-empty", "selects none of " + std::to_string(from.size()) + " points",
            "are its lengths in the scene's unit?");
  }
  std::vector<Vec3> places;
  for (const Index i : inside) places.push_back(from[static_cast<std::size_t>(i)]);
  const auto select = [&]<std::size_t N>(const Attribute<std::vector<std::array<Index, N>>>& given,
                                         std::span<const std::array<Index, N>> topologys,
                                         Attribute<IndexList>& out) {
    const auto elements = given.isSet() ? std::span(*given) : topologys;
    if (given.isSet()) {
      const std::string problem = elementProblem(elements, static_cast<Index>(from.size()));
      if (!problem.empty()) error(given, "topology-index", problem);
    }
    out.set({elementsOf(inside, elements, strict)});
  };
  // the elements of a topology belong to its own points
  const Topology* own =
      topology && topology->positions().size() == from.size() ? topology.get() : nullptr;
  select(edges, own ? own->edges() : std::span<const Edge>{}, edgeIndices);
  select(triangles, own ? own->triangles() : std::span<const Triangle>{}, triangleIndices);
  select(tetrahedra, own ? own->tetrahedra() : std::span<const Tetrahedron>{}, tetrahedronIndices);
  indices.set({std::move(inside)});
  pointsInROI.set(std::move(places));
}

bool BoxRoi::prepare() {
  if (box->empty() && orientedBox->empty()) {
    error("attr-required", "needs 'box' or 'orientedBox'");
    return false;
  }
  if (orientedBox->size() % 10 != 0) {
    error(orientedBox, "roi-box",
          "has " + std::to_string(orientedBox->size()) + " numbers; a turned box has ten");
    return false;
  }
  for (std::size_t i = 0; i < orientedBox->size(); i += 10) {
    turned_.push_back(stroma::orientedBox(std::span(*orientedBox).subspan(i).first<10>()));
    if (!(turned_.back().size.array() > 0).all()) {
      error(orientedBox, "roi-box",
            "box " + std::to_string(i / 10) +
                " has no volume: p0, p1 and p2 lie on a line, or "
                "its depth is not positive");
      return false;
    }
  }
  return true;
}

bool BoxRoi::isInside(const Vec3& point) const {
  const auto holds = [&](const auto& region) { return contains(region, point); };
  return std::ranges::any_of(*box, holds) || std::ranges::any_of(turned_, holds);
}

bool SphereRoi::prepare() {
  if (radii->size() == 1 || radii->size() == centers->size()) return true;
  error(radii, "roi-radii",
        "has " + std::to_string(radii->size()) + " values for " + std::to_string(centers->size()) +
            " centres");
  return false;
}

bool SphereRoi::isInside(const Vec3& point) const {
  for (std::size_t i = 0; i < centers->size(); ++i) {
    const double radius = (*radii)[radii->size() == 1 ? 0 : i];
    if (contains(Ball{(*centers)[i], radius}, point)) return true;
  }
  return false;
}

}  // namespace stroma
