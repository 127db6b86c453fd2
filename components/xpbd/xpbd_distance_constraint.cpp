// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_distance_constraint.h"

#include <algorithm>

#include "core/element_body.h"

namespace stroma {
namespace {

template <std::size_t N>
void addPairs(std::span<const std::array<Index, N>> elements, std::vector<Edge>& pairs) {
  for (const auto& nodes : elements) {
    for (std::size_t b = 1; b < N; ++b) {
      for (std::size_t a = 0; a < b; ++a)
        pairs.push_back({std::min(nodes[a], nodes[b]), std::max(nodes[a], nodes[b])});
    }
  }
}

// All pairs of nodes of an element, each once, ascending.
std::vector<Edge> pairsOf(const Topology& topology) {
  std::vector<Edge> pairs;
  addPairs(topology.edges(), pairs);
  addPairs(topology.triangles(), pairs);
  addPairs(topology.tetrahedra(), pairs);
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  return pairs;
}

}  // namespace

void XpbdDistanceConstraint::bind() {
  const std::vector<Edge> edges = pairsOf(*topology);
  if (!checkElements(*this, topology, *mechanicalState, edges.size(),
                     "edges, triangles or tetrahedra"))
    return;
  const ConstVec3Span rest = mechanicalState->rest();
  const auto flat = std::ranges::find_if(edges, [&](const Edge& e) {
    return rest[static_cast<std::size_t>(e[0])] == rest[static_cast<std::size_t>(e[1])];
  });
  if (flat != edges.end()) {
    error(topology, "edge-no-length",
          "'" + topology->path() + "' has an edge without length, from particle " +
              std::to_string((*flat)[0]) + " to " + std::to_string((*flat)[1]));
    return;
  }
  warnOfLoose({edges.front().data(), 2 * edges.size()});
  edges_.emplace(rest, edges);
  edges_->setStiffness(stiffness);
  colours.set(edges_->colours());
}

}  // namespace stroma
