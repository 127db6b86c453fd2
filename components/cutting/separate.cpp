// SPDX-License-Identifier: Apache-2.0
// SimplicialComplex::separate: which facets may become free, and what nodes they get.
#include <algorithm>
#include <limits>

#include "components/cutting/simplicial_complex.h"
#include "core/sorted_ids.h"

namespace stroma {
namespace {

// Slot of a facet that is being freed: it blocks already but has no surface triangle yet.
constexpr Index pendingSlot = std::numeric_limits<Index>::max();

}  // namespace

bool SimplicialComplex::isPending(Facet f) const {
  return slot_[at(f.simplex)][corner(f.corner)] == pendingSlot;
}

void SimplicialComplex::setPending(Facet f, bool pending) {
  setSlot(f, pending ? pendingSlot : -1);
  setSlot(otherSide(f), pending ? pendingSlot : -1);
}

bool SimplicialComplex::refuse(std::vector<Facet>& facets, const std::vector<char>& refused) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    if (refused[k])
      setPending(facets[k], false);
    else
      facets[kept++] = facets[k];
  }
  const bool any = kept < facets.size();
  facets.resize(kept);
  return any;
}

// Facets all of whose vertices stay single would be two triangles on the same three nodes.
bool SimplicialComplex::refuseClosed(std::vector<Facet>& facets) {
  std::vector<char> refused(facets.size(), 0);
  std::vector<Index> labels;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    const Facet f = facets[k];
    const Index n = across(f);
    refused[k] = 1;
    for (const Index v : facetVertices(f)) {
      labelStar(v, labels);
      const auto around = star(v);
      const auto here = std::find(around.begin(), around.end(), f.simplex) - around.begin();
      const auto there = std::find(around.begin(), around.end(), n) - around.begin();
      if (labels[static_cast<std::size_t>(here)] == labels[static_cast<std::size_t>(there)])
        continue;
      refused[k] = 0;
      break;
    }
  }
  return refuse(facets, refused);
}

// Two fans in one part of a vertex's star touch there and nowhere else.
bool SimplicialComplex::refuseTouching(std::vector<Facet>& facets) {
  std::vector<Index> vertices, labels;
  for (const Facet f : facets)
    for (const Index v : facetVertices(f)) vertices.push_back(v);
  sortUnique(vertices);
  std::vector<char> refused(facets.size(), 0);
  const auto refusePending = [&](const Fan& fan) {
    for (const Facet f : fan.facets)
      for (std::size_t k = 0; k < facets.size() && isPending(f); ++k) {
        const Facet g = facets[k], other = otherSide(g);
        if ((f.simplex == g.simplex && f.corner == g.corner) ||
            (f.simplex == other.simplex && f.corner == other.corner))
          refused[k] = 1;
      }
  };
  for (const Index v : vertices) {
    const std::vector<Fan> fans = fansAt(v);
    if (fans.size() < 2) continue;
    labelStar(v, labels);
    const auto around = star(v);
    std::vector<Index> part;
    for (const Fan& fan : fans) {
      const auto where = std::find(around.begin(), around.end(), fan.facets[0].simplex);
      part.push_back(labels[static_cast<std::size_t>(where - around.begin())]);
    }
    for (std::size_t a = 0; a < fans.size(); ++a)
      if (std::count(part.begin(), part.end(), part[a]) > 1) refusePending(fans[a]);
  }
  return refuse(facets, refused);
}

// Do the parts into which the free facets divide the ring around an edge have different nodes at
// one of its ends at least?
bool SimplicialComplex::opens(Index v, Index w) const {
  std::vector<Index> labelsV, labelsW;
  std::vector<std::pair<Index, Index>> parts;
  for (std::size_t k = 0; k < star(v).size(); ++k) {
    const Index t = star(v)[k];
    if (cornerOf(t, w) < 0) continue;
    for (int i = 0; i < 4; ++i) {
      const Index o = simplex(t)[corner(i)];
      if (o == v || o == w || !isFree({t, i})) continue;
      if (labelsV.empty()) {
        labelStar(v, labelsV);
        labelStar(w, labelsW);
      }
      const auto inW = std::find(star(w).begin(), star(w).end(), t) - star(w).begin();
      parts.emplace_back(labelsV[k], labelsW[static_cast<std::size_t>(inW)]);
    }
  }
  // each part of the ring ends at two free facets
  std::sort(parts.begin(), parts.end());
  for (std::size_t k = 2; k < parts.size(); ++k)
    if (parts[k] == parts[k - 2]) return false;
  return true;
}

std::vector<Edge> SimplicialComplex::stuckEdges(std::span<const Facet> facets,
                                                std::vector<char>& refused) const {
  std::vector<Edge> edges;
  refused.assign(facets.size(), 0);
  for (std::size_t k = 0; k < facets.size(); ++k) {
    const Triangle f = facetVertices(facets[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge e = {std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])};
      if (opens(e[0], e[1])) continue;
      refused[k] = 1;
      edges.push_back(e);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Index SimplicialComplex::separate(std::span<const Facet> facets, bool last,
                                  std::vector<Edge>* stuck) {
  std::vector<Facet> pending;
  for (const Facet f : facets)
    if (!isFree(f) && across(f) >= 0) {
      setPending(f, true);
      pending.push_back(f);
    }
  std::vector<char> refused;
  for (bool again = dimension_ == 3; again;) {
    while (refuseClosed(pending) || (!last && refuseTouching(pending))) {
    }
    const std::vector<Edge> edges = stuckEdges(pending, refused);
    again = !edges.empty();
    if (again && stuck) {
      *stuck = edges;
      for (const Facet f : pending) setPending(f, false);
      return 0;
    }
    if (again) refuse(pending, refused);
  }

  std::vector<Index> vertices;
  for (const Facet f : pending) {
    const Facet g = otherSide(f);
    const Triangle face = facetVertices(f);
    for (const Index v : face)
      if (v >= 0) vertices.push_back(v);
    if (dimension_ == 2) {
      setSlot(f, 0);
      setSlot(g, 0);
      continue;
    }
    newCutFacets_.push_back({vertex(face[0]), vertex(face[1]), vertex(face[2])});
    setSlot(f, addTriangle({~face[0], ~face[1], ~face[2]}, -1, true, f));
    setSlot(g, addTriangle({~face[0], ~face[2], ~face[1]}, -1, true, g));
  }
  sortUnique(vertices);
  for (const Index v : vertices) assignNodes(v);
  return static_cast<Index>(pending.size());
}

// Every fan gets a node of its own. A node stays with the fan that holds its oldest triangle.
void SimplicialComplex::assignNodes(Index v) {
  struct Claim {
    Index node, slot;
    std::size_t fan;
  };
  const std::vector<Fan> fans = fansAt(v);
  std::vector<std::vector<Index>> slots(fans.size());
  std::vector<Claim> claims;
  for (std::size_t k = 0; k < fans.size(); ++k) {
    for (const Facet f : fans[k].facets) slots[k].push_back(slot_[at(f.simplex)][corner(f.corner)]);
    if (dimension_ == 2) slots[k] = fans[k].simplices;
    std::sort(slots[k].begin(), slots[k].end());
    for (const Index s : slots[k])
      if (const Index n = nodeAt(s, v); n >= 0) claims.push_back({n, s, k});
  }
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return std::pair(a.node, a.slot) < std::pair(b.node, b.slot);
  });

  std::vector<Index> node(fans.size(), -1), origin(fans.size(), -1);
  for (std::size_t c = 0; c < claims.size();) {
    const Index n = claims[c].node;
    bool taken = false;
    for (; c < claims.size() && claims[c].node == n; ++c) {
      const std::size_t k = claims[c].fan;
      if (origin[k] < 0) origin[k] = n;
      if (taken || node[k] >= 0) continue;
      node[k] = n;
      taken = true;
    }
    if (!taken) retired_.push_back(n);
  }
  // oldest fan first, so that numbers do not depend on the order of the star
  std::vector<std::size_t> order(fans.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return slots[a].front() < slots[b].front(); });
  Index source = -1;
  for (const std::size_t k : order) {
    if (node[k] < 0)
      node[k] = addNode(v, {vertex(v), origin[k] >= 0 ? origin[k] : source, {-1, -1}, 0.0});
    if (source < 0) source = node[k];
    for (const Index s : slots[k]) replaceNode(s, v, node[k]);
  }
}

// === What has changed

std::vector<TouchedNode> SimplicialComplex::touchedNodes(std::span<const Index> slots) const {
  // of the simplices behind a node's triangles the largest has the safest inside
  struct Candidate {
    Index node, simplex;
    double size;
  };
  std::vector<Candidate> candidates;
  for (const Index s : slots) {
    const Index t = behind(s);
    const Simplex& c = simplex(t);
    const Vec3 normal = (vertex(c[1]) - vertex(c[0])).cross(vertex(c[2]) - vertex(c[0]));
    const double size =
        dimension_ == 2 ? normal.norm() : std::abs(normal.dot(vertex(c[3]) - vertex(c[0])));
    for (const Index n : triangles_[at(s)]) candidates.push_back({n, t, size});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.node != b.node) return a.node < b.node;
    return a.size != b.size ? a.size > b.size : a.simplex < b.simplex;
  });
  // of the way to the centroid: the walls of a solid are exact; the sheet that cuts an open one may
  // pass its seam's nodes on either side, as far as vertices snap to it
  const double inward = dimension_ == 3 ? 0.02 : 0.9;
  std::vector<TouchedNode> touched;
  for (const Candidate& c : candidates)
    if (touched.empty() || touched.back().node != c.node)
      touched.push_back(
          {c.node, (1 - inward) * nodePosition(c.node) + inward * centroid(c.simplex)});
  return touched;
}

SurfaceEdit SimplicialComplex::takeEdit() {
  SurfaceEdit edit;
  edit.firstNewNode = nodeCount() - static_cast<Index>(newNodes_.size());
  edit.firstNewTriangle = editedTriangles_;
  edit.nodes.swap(newNodes_);
  edit.cutFacets.swap(newCutFacets_);
  edit.retired.swap(retired_);
  sortUnique(changedSlots_);
  std::vector<Index> slots;
  for (const Index s : changedSlots_) {
    if (s >= editedTriangles_) continue;
    edit.changed.push_back({s, triangles_[at(s)]});
    slots.push_back(s);
  }
  for (Index s = editedTriangles_; s < static_cast<Index>(triangles_.size()); ++s) {
    edit.appended.push_back({triangles_[at(s)], triangleParent_[at(s)], isWall(s)});
    slots.push_back(s);
  }
  edit.touched = touchedNodes(slots);
  editedTriangles_ = static_cast<Index>(triangles_.size());
  changedSlots_.clear();
  return edit;
}

}  // namespace stroma
