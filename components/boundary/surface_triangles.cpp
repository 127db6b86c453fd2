// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/surface_triangles.h"

#include <algorithm>

namespace stroma {

bool SurfaceTriangles::select(Component& component, const MechanicalState& state,
                              const Topology* topology,
                              const Attribute<std::vector<Triangle>>& given,
                              const Attribute<IndexList>& subset) {
  if (given.isSet()) {
    triangles_ = given;
  } else if (topology) {
    triangles_.assign(topology->triangles().begin(), topology->triangles().end());
  }
  const auto total = static_cast<Index>(triangles_.size());
  if (total == 0) {
    component.error("triangles-empty", "has no triangles to act on",
                    "give 'triangles', or a topology with triangles to the node");
    return false;
  }
  if (subset.isSet()) {
    std::vector<Triangle> chosen;
    for (const Index t : subset->indices) {
      if (t < 0 || t >= total) {
        component.error(
            subset, "index-range",
            "names triangle " + std::to_string(t) + ", but there are " + std::to_string(total),
            "triangles are counted from 0 to " + std::to_string(total - 1));
        return false;
      }
      chosen.push_back(triangles_[static_cast<std::size_t>(t)]);
    }
    triangles_ = std::move(chosen);
    if (triangles_.empty()) component.warning("index-empty", "acts on no triangle");
  }
  for (const Triangle& triangle : triangles_) {
    for (const Index node : triangle) {
      if (node >= 0 && node < state.size()) continue;
      component.error("index-range",
                      "a triangle has node " + std::to_string(node) + ", but '" + state.path() +
                          "' has " + std::to_string(state.size()) + " particles",
                      "the load acts on a state of surface nodes; is 'state' the right one?");
      return false;
    }
  }
  gatherCorners();
  findRim();
  return true;
}

void SurfaceTriangles::gatherCorners() {
  std::vector<std::pair<Index, Corner>> all;
  for (Index t = 0; t < count(); ++t) {
    for (int c = 0; c < 3; ++c) {
      all.push_back({triangles_[static_cast<std::size_t>(t)][static_cast<std::size_t>(c)], {t, c}});
    }
  }
  std::ranges::stable_sort(all, {}, [](const auto& entry) { return entry.first; });
  nodes_.clear();
  begin_.clear();
  corners_.clear();
  for (const auto& [node, corner] : all) {
    if (nodes_.empty() || nodes_.back() != node) {
      nodes_.push_back(node);
      begin_.push_back(corners_.size());
    }
    corners_.push_back(corner);
  }
  begin_.push_back(corners_.size());
}

void SurfaceTriangles::findRim() {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles_) {
    for (std::size_t c = 0; c < 3; ++c) edges.push_back({t[c], t[(c + 1) % 3]});
  }
  std::ranges::sort(edges);
  rim_.clear();
  for (const Edge& e : edges) {
    if (std::ranges::binary_search(edges, Edge{e[1], e[0]})) continue;
    rim_.push_back(e[0]);
    rim_.push_back(e[1]);
  }
  std::ranges::sort(rim_);
  rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
}

}  // namespace stroma
