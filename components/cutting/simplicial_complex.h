// SPDX-License-Identifier: Apache-2.0
// A body as a conforming mesh of simplices in the rest configuration, kept for topology only:
// tetrahedra for a solid (dimension 3), triangles for an open sheet (dimension 2). Two operations
// change it, and neither can break it:
//
//   splitEdge   a new vertex on an edge; every simplex around the edge is bisected.
//   separate    interior facets (triangles of tetrahedra, edges of triangles) become free.
//
// Vertices are points of space: a cut does not copy them, it only forbids to walk through a facet.
// The surface has nodes of its own. A node is a vertex together with the simplices around it that
// can be reached from each other across facets which are not free; so the two sides of an incision
// have different nodes at the same vertex, and its tip has one. The walls of an incision are the
// two sides of the same facets, hence coincide exactly, and no volume is lost. Nodes of the
// original surface come first and keep their numbers, as do its triangles.
//
// What is always true of the surface: every edge between two nodes has two triangles (one on a rim
// of an open sheet), every node has one fan, and pieces are closed. `separate` refuses the facets
// that would break this, which are those at a front that do not open it (a triangle all of whose
// nodes stay single, an edge whose two ends stay single while both its sides are cut) and, unless
// `last` is given, those where two incisions would touch in a vertex only. A caller offers them
// again later, when the incision is longer. With `last` the touching ones are accepted and the
// vertex gets one node for each fan; when a later cut joins such fans, one of the nodes is retired.
#pragma once

#include <span>
#include <vector>

#include "core/topology_change.h"
#include "core/types.h"

namespace stroma {

class SimplicialComplex {
 public:
  using Simplex = std::array<Index, 4>;  // the fourth is -1 for triangles
  struct Facet {                         // the facet of a simplex opposite its corner `corner`
    Index simplex = -1;
    int corner = -1;
  };

  // Solid whose boundary is exactly `surface`, outward; its nodes are the first `points`. Throws
  // std::invalid_argument that says what does not fit.
  [[nodiscard]] static SimplicialComplex fromTetrahedra(ConstVec3Span points,
                                                        std::span<const Tetrahedron> tetrahedra,
                                                        std::span<const Triangle> surface);
  // The same with the boundary found here, in the order of the tetrahedra.
  [[nodiscard]] static SimplicialComplex fromTetrahedra(ConstVec3Span points,
                                                        std::span<const Tetrahedron> tetrahedra);
  // Open sheet: the triangles are the surface.
  [[nodiscard]] static SimplicialComplex fromTriangles(ConstVec3Span points,
                                                       std::span<const Triangle> triangles);

  // Vertex on the edge pq at (1 - weight) p + weight q. Returns its index. O(simplices at p).
  Index splitEdge(Index p, Index q, double weight);
  // Frees facets and returns how many were accepted. If edges whose two ends stay single are in the
  // way, nothing is done and `stuck` gets them: split them and offer the facets again. Without
  // `stuck` the facets at such edges are refused.
  Index separate(std::span<const Facet> facets, bool last, std::vector<Edge>* stuck = nullptr);
  // What has changed since the last call.
  [[nodiscard]] SurfaceEdit takeEdit();

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int corners() const { return dimension_ + 1; }
  [[nodiscard]] Index vertexCount() const { return static_cast<Index>(vertices_.size()); }
  [[nodiscard]] const Vec3& vertex(Index v) const { return vertices_[at(v)]; }
  [[nodiscard]] Index simplexCount() const { return static_cast<Index>(simplices_.size()); }
  [[nodiscard]] const Simplex& simplex(Index t) const { return simplices_[at(t)]; }
  // Simplices around a vertex.
  [[nodiscard]] std::span<const Index> star(Index v) const { return star_[at(v)]; }
  // Simplex across a facet, whether free or not; -1 at the outside.
  [[nodiscard]] Index across(Facet f) const { return across_[at(f.simplex)][corner(f.corner)]; }
  // Facet is outside or separated.
  [[nodiscard]] bool isFree(Facet f) const { return slot_[at(f.simplex)][corner(f.corner)] >= 0; }
  // Vertices of a facet, outward for a tetrahedron; the third is -1 for triangles.
  [[nodiscard]] Triangle facetVertices(Facet f) const;
  [[nodiscard]] Vec3 centroid(Index t) const;
  [[nodiscard]] double volume(Index t) const;  // of a tetrahedron [m^3]
  [[nodiscard]] double meanEdgeLength() const;
  [[nodiscard]] double longestEdge() const;

  [[nodiscard]] std::span<const Triangle> surface() const { return triangles_; }
  [[nodiscard]] bool isWall(Index triangle) const { return wall_[at(triangle)] != 0; }
  // Simplex behind a surface triangle.
  [[nodiscard]] Index behind(Index triangle) const;
  [[nodiscard]] Index nodeCount() const { return static_cast<Index>(nodeVertex_.size()); }
  [[nodiscard]] Index nodeVertex(Index node) const { return nodeVertex_[at(node)]; }
  [[nodiscard]] const Vec3& nodePosition(Index node) const { return vertex(nodeVertex(node)); }
  [[nodiscard]] std::vector<Vec3> nodePositions() const;
  // Facets separated so far, one of the two sides each.
  [[nodiscard]] std::vector<Facet> separatedFacets() const;
  // Piece of every simplex, numbered from 0 in order of appearance. O(whole body).
  [[nodiscard]] std::vector<Index> pieces(Index& count) const;

 private:
  using Slots = std::array<Index, 4>;
  struct Fan {                     // faces of one node at a vertex
    std::vector<Facet> facets;     // free facets at the vertex (dimension 3)
    std::vector<Index> simplices;  // simplices at the vertex (dimension 2)
  };

  // Vertices and adjacency, no surface yet.
  [[nodiscard]] static SimplicialComplex bareTetrahedra(ConstVec3Span points,
                                                        std::span<const Tetrahedron> tetrahedra);
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  static std::size_t corner(int i) { return static_cast<std::size_t>(i); }
  void buildAdjacency();
  void buildSurface(std::span<const Triangle> surface);
  [[nodiscard]] int cornerOf(Index t, Index v) const;
  [[nodiscard]] int facetTo(Index t, Index neighbour) const;
  void markChanged(Index slot) { changedSlots_.push_back(slot); }
  Index addNode(Index vertex, const NewSurfaceNode& node);
  Index addTriangle(const Triangle& nodes, Index parent, bool wall, Facet owner);
  void splitSurface(Index p, Index q, Index m, double weight, std::span<const Index> ring,
                    Index first);
  [[nodiscard]] std::vector<Index> nodesOnEdge(Index p, Index q, Index m, double weight,
                                               std::span<const Index> ring);
  void replaceNode(Index slot, Index oldVertex, Index node);
  [[nodiscard]] Index nodeAt(Index slot, Index vertex) const;

  void setSlot(Facet f, Index slot);
  [[nodiscard]] Facet otherSide(Facet f) const;
  // Label of every simplex of a vertex's star: its part across facets that are not free.
  void labelStar(Index v, std::vector<Index>& labels) const;
  [[nodiscard]] Facet nextAround(Facet f, Index v, Index w) const;
  [[nodiscard]] std::vector<Fan> fansAt(Index v) const;
  [[nodiscard]] bool isPending(Facet f) const;
  void setPending(Facet f, bool pending);
  bool refuse(std::vector<Facet>& facets, const std::vector<char>& refused);
  bool refuseClosed(std::vector<Facet>& facets);
  bool refuseTouching(std::vector<Facet>& facets);
  [[nodiscard]] bool opens(Index v, Index w) const;
  [[nodiscard]] std::vector<Edge> stuckEdges(std::span<const Facet> facets,
                                             std::vector<char>& refused) const;
  void assignNodes(Index v);
  [[nodiscard]] std::vector<TouchedNode> touchedNodes(std::span<const Index> slots) const;

  int dimension_ = 3;
  std::vector<Vec3> vertices_;
  std::vector<Simplex> simplices_;
  std::vector<Slots> across_;
  std::vector<Slots> slot_;  // surface triangle of a facet (dimension 2: 0), -1 if not free
  std::vector<std::vector<Index>> star_;

  std::vector<Triangle> triangles_;
  std::vector<Facet> owner_;  // dimension 3: facet of each surface triangle
  std::vector<char> wall_;
  std::vector<Index> triangleParent_;
  std::vector<Index> nodeVertex_;

  // since the last takeEdit
  std::vector<NewSurfaceNode> newNodes_;
  std::vector<Index> changedSlots_, retired_;
  std::vector<RestTriangle> newCutFacets_;
  Index editedTriangles_ = 0;
};

}  // namespace stroma
