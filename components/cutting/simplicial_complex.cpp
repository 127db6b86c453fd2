// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/simplicial_complex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace stroma {
namespace {

// Corners of the facet opposite corner i, outward for a positively oriented tetrahedron.
constexpr int tetFacet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

struct KeyedFacet {
  Triangle key;
  SimplicialComplex::Facet facet;
  bool operator<(const KeyedFacet& b) const {
    return key != b.key ? key < b.key
                        : std::pair(facet.simplex, facet.corner) <
                              std::pair(b.facet.simplex, b.facet.corner);
  }
};

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

double signedVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6;
}

}  // namespace

// === Construction

SimplicialComplex SimplicialComplex::bareTetrahedra(ConstVec3Span points,
                                                    std::span<const Tetrahedron> tetrahedra) {
  SimplicialComplex complex;
  complex.vertices_.assign(points.begin(), points.end());
  complex.simplices_.assign(tetrahedra.begin(), tetrahedra.end());
  for (Simplex& s : complex.simplices_) {
    for (const Index v : s)
      if (v < 0 || v >= complex.vertexCount())
        throw std::invalid_argument("tetrahedron with vertex " + std::to_string(v) + " of " +
                                    std::to_string(points.size()));
    if (signedVolume(points[at(s[0])], points[at(s[1])], points[at(s[2])], points[at(s[3])]) < 0)
      std::swap(s[2], s[3]);
  }
  complex.buildAdjacency();
  return complex;
}

SimplicialComplex SimplicialComplex::fromTetrahedra(ConstVec3Span points,
                                                    std::span<const Tetrahedron> tetrahedra,
                                                    std::span<const Triangle> surface) {
  SimplicialComplex complex = bareTetrahedra(points, tetrahedra);
  complex.buildSurface(surface);
  return complex;
}

SimplicialComplex SimplicialComplex::fromTetrahedra(ConstVec3Span points,
                                                    std::span<const Tetrahedron> tetrahedra) {
  SimplicialComplex complex = bareTetrahedra(points, tetrahedra);
  std::vector<Triangle> surface;
  for (Index t = 0; t < complex.simplexCount(); ++t)
    for (int i = 0; i < 4; ++i)
      if (complex.across({t, i}) < 0) surface.push_back(complex.facetVertices({t, i}));
  complex.buildSurface(surface);
  return complex;
}

SimplicialComplex SimplicialComplex::fromTriangles(ConstVec3Span points,
                                                   std::span<const Triangle> triangles) {
  SimplicialComplex complex;
  complex.dimension_ = 2;
  complex.vertices_.assign(points.begin(), points.end());
  for (const Triangle& t : triangles) {
    for (const Index v : t)
      if (v < 0 || v >= complex.vertexCount())
        throw std::invalid_argument("triangle with vertex " + std::to_string(v) + " of " +
                                    std::to_string(points.size()));
    complex.simplices_.push_back({t[0], t[1], t[2], -1});
  }
  complex.buildAdjacency();
  complex.buildSurface(triangles);
  return complex;
}

void SimplicialComplex::buildAdjacency() {
  star_.assign(vertices_.size(), {});
  across_.assign(simplices_.size(), {-1, -1, -1, -1});
  slot_.assign(simplices_.size(), {-1, -1, -1, -1});
  std::vector<KeyedFacet> facets;
  facets.reserve(simplices_.size() * corner(corners()));
  for (Index t = 0; t < simplexCount(); ++t)
    for (int i = 0; i < corners(); ++i) {
      star_[at(simplex(t)[corner(i)])].push_back(t);
      facets.push_back({sorted(facetVertices({t, i})), {t, i}});
    }
  std::sort(facets.begin(), facets.end());
  for (std::size_t k = 0; k + 1 < facets.size(); ++k) {
    if (facets[k].key != facets[k + 1].key) continue;
    if (k + 2 < facets.size() && facets[k].key == facets[k + 2].key)
      throw std::invalid_argument("three simplices share the facet with vertex " +
                                  std::to_string(facets[k].key[2]));
    const Facet a = facets[k].facet, b = facets[k + 1].facet;
    across_[at(a.simplex)][corner(a.corner)] = b.simplex;
    across_[at(b.simplex)][corner(b.corner)] = a.simplex;
  }
}

void SimplicialComplex::buildSurface(std::span<const Triangle> surface) {
  Index nodes = 0;
  for (const Triangle& t : surface)
    for (const Index v : t) nodes = std::max(nodes, v + 1);
  // a sheet's unused points stay nodes, so that numbers agree
  if (dimension_ == 2) nodes = vertexCount();
  // room to grow, so that no cut pays for moving the whole body
  const auto spare = [](auto& list) { list.reserve(list.size() + list.size() / 4 + 4096); };
  spare(vertices_);
  spare(star_);
  spare(simplices_);
  spare(across_);
  spare(slot_);
  if (nodes > vertexCount()) throw std::invalid_argument("surface has more nodes than points");
  for (Index n = 0; n < nodes; ++n) nodeVertex_.push_back(n);
  triangles_.assign(surface.begin(), surface.end());
  wall_.assign(triangles_.size(), 0);
  triangleParent_.assign(triangles_.size(), -1);
  editedTriangles_ = static_cast<Index>(triangles_.size());

  std::vector<KeyedFacet> outside;
  for (Index t = 0; t < simplexCount(); ++t)
    for (int i = 0; i < corners(); ++i)
      if (across({t, i}) < 0) outside.push_back({sorted(facetVertices({t, i})), {t, i}});
  if (dimension_ == 2) {
    for (const KeyedFacet& f : outside) slot_[at(f.facet.simplex)][corner(f.facet.corner)] = 0;
    return;
  }
  if (outside.size() != surface.size())
    throw std::invalid_argument("the tetrahedra have " + std::to_string(outside.size()) +
                                " boundary triangles, the surface " +
                                std::to_string(surface.size()));
  std::sort(outside.begin(), outside.end());
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const KeyedFacet key{sorted(surface[s]), {-1, -1}};
    const auto found = std::lower_bound(outside.begin(), outside.end(), key);
    if (found == outside.end() || found->key != key.key)
      throw std::invalid_argument("surface triangle " + std::to_string(s) +
                                  " is no boundary triangle of the tetrahedra");
    owner_.push_back(found->facet);
    slot_[at(found->facet.simplex)][corner(found->facet.corner)] = static_cast<Index>(s);
  }
  double solid = 0, enclosed = 0;
  for (Index t = 0; t < simplexCount(); ++t) solid += volume(t);
  for (const Triangle& t : surface)
    enclosed += signedVolume(vertex(t[0]), vertex(t[1]), vertex(t[2]), vertices_[0]);
  constexpr double tolerance = 1e-9;
  if (std::abs(-enclosed - solid) > tolerance * solid)
    throw std::invalid_argument("the surface encloses " + std::to_string(-enclosed / solid) +
                                " of the tetrahedra's volume: they overlap, or it faces inwards");
}

// === Small questions

int SimplicialComplex::cornerOf(Index t, Index v) const {
  const Simplex& s = simplex(t);
  for (int i = 0; i < corners(); ++i)
    if (s[corner(i)] == v) return i;
  return -1;
}

int SimplicialComplex::facetTo(Index t, Index neighbour) const {
  for (int i = 0; i < corners(); ++i)
    if (across_[at(t)][corner(i)] == neighbour) return i;
  return -1;
}

Triangle SimplicialComplex::facetVertices(Facet f) const {
  const Simplex& s = simplex(f.simplex);
  if (dimension_ == 2) return {s[corner((f.corner + 1) % 3)], s[corner((f.corner + 2) % 3)], -1};
  const auto& c = tetFacet[f.corner];
  return {s[corner(c[0])], s[corner(c[1])], s[corner(c[2])]};
}

Vec3 SimplicialComplex::centroid(Index t) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < corners(); ++i) sum += vertex(simplex(t)[corner(i)]);
  return sum / corners();
}

double SimplicialComplex::volume(Index t) const {
  const Simplex& s = simplex(t);
  return signedVolume(vertex(s[0]), vertex(s[1]), vertex(s[2]), vertex(s[3]));
}

double SimplicialComplex::meanEdgeLength() const {
  double sum = 0;
  Index count = 0;
  for (Index t = 0; t < simplexCount(); ++t)
    for (int i = 0; i < corners(); ++i)
      for (int j = 0; j < i; ++j, ++count)
        sum += (vertex(simplex(t)[corner(i)]) - vertex(simplex(t)[corner(j)])).norm();
  return count > 0 ? sum / count : 0.0;
}

double SimplicialComplex::longestEdge() const {
  double longest = 0;
  for (Index t = 0; t < simplexCount(); ++t)
    for (int i = 0; i < corners(); ++i)
      for (int j = 0; j < i; ++j)
        longest = std::max(longest,
                           (vertex(simplex(t)[corner(i)]) - vertex(simplex(t)[corner(j)])).norm());
  return longest;
}

Index SimplicialComplex::behind(Index triangle) const {
  return dimension_ == 2 ? triangle : owner_[at(triangle)].simplex;
}

std::vector<Vec3> SimplicialComplex::nodePositions() const {
  std::vector<Vec3> positions;
  positions.reserve(nodeVertex_.size());
  for (const Index v : nodeVertex_) positions.push_back(vertex(v));
  return positions;
}

std::vector<SimplicialComplex::Facet> SimplicialComplex::separatedFacets() const {
  std::vector<Facet> facets;
  for (Index t = 0; t < simplexCount(); ++t)
    for (int i = 0; i < corners(); ++i)
      if (isFree({t, i}) && across({t, i}) > t) facets.push_back({t, i});
  return facets;
}

std::vector<Index> SimplicialComplex::pieces(Index& count) const {
  std::vector<Index> piece(simplices_.size(), -1), stack;
  count = 0;
  for (Index seed = 0; seed < simplexCount(); ++seed) {
    if (piece[at(seed)] >= 0) continue;
    stack.assign(1, seed);
    piece[at(seed)] = count;
    while (!stack.empty()) {
      const Index t = stack.back();
      stack.pop_back();
      for (int i = 0; i < corners(); ++i) {
        const Index n = across({t, i});
        if (n < 0 || isFree({t, i}) || piece[at(n)] >= 0) continue;
        piece[at(n)] = count;
        stack.push_back(n);
      }
    }
    ++count;
  }
  return piece;
}

// === Nodes and triangles of the surface

Index SimplicialComplex::addNode(Index v, const NewSurfaceNode& node) {
  nodeVertex_.push_back(v);
  newNodes_.push_back(node);
  return nodeCount() - 1;
}

Index SimplicialComplex::addTriangle(const Triangle& nodes, Index parent, bool wall, Facet owner) {
  triangles_.push_back(nodes);
  triangleParent_.push_back(parent);
  wall_.push_back(wall ? 1 : 0);
  if (dimension_ == 3) owner_.push_back(owner);
  return static_cast<Index>(triangles_.size()) - 1;
}

// A wall that is being made holds ~vertex instead of nodes until assignNodes has run.
Index SimplicialComplex::nodeAt(Index slot, Index v) const {
  for (const Index n : triangles_[at(slot)])
    if (n >= 0 && nodeVertex(n) == v) return n;
  return -1;
}

void SimplicialComplex::replaceNode(Index slot, Index oldVertex, Index node) {
  for (Index& n : triangles_[at(slot)])
    if (n == ~oldVertex || (n >= 0 && nodeVertex(n) == oldVertex)) {
      if (n != node) markChanged(slot);
      n = node;
      return;
    }
}

// === Splitting an edge

Index SimplicialComplex::splitEdge(Index p, Index q, double weight) {
  std::vector<Index> ring;
  for (const Index t : star(p))
    if (cornerOf(t, q) >= 0) ring.push_back(t);
  std::sort(ring.begin(), ring.end());

  const Index m = vertexCount(), first = simplexCount();
  vertices_.push_back((1 - weight) * vertex(p) + weight * vertex(q));
  star_.emplace_back();
  splitSurface(p, q, m, weight, ring, first);

  // each simplex keeps its half at p; the half at q is appended
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Index t = ring[k], half = first + static_cast<Index>(k);
    const int atP = cornerOf(t, p), atQ = cornerOf(t, q);
    simplices_[at(t)][corner(atQ)] = m;
    simplices_[at(half)][corner(atP)] = m;

    const Index outer = across_[at(t)][corner(atP)];
    if (outer >= 0) across_[at(outer)][corner(facetTo(outer, t))] = half;
    if (dimension_ == 3 && slot_[at(half)][corner(atP)] >= 0)
      owner_[at(slot_[at(half)][corner(atP)])] = {half, atP};
    across_[at(t)][corner(atP)] = half;
    slot_[at(t)][corner(atP)] = -1;
    across_[at(half)][corner(atQ)] = t;
    slot_[at(half)][corner(atQ)] = -1;
    for (int i = 0; i < corners(); ++i) {
      if (i == atP || i == atQ) continue;
      const Index n = across_[at(t)][corner(i)];
      if (n < 0) continue;
      const auto position = std::lower_bound(ring.begin(), ring.end(), n) - ring.begin();
      across_[at(half)][corner(i)] = first + static_cast<Index>(position);
    }

    auto& starQ = star_[at(q)];
    *std::find(starQ.begin(), starQ.end(), t) = half;
    for (int i = 0; i < corners(); ++i)
      if (i != atP && i != atQ) star_[at(simplex(t)[corner(i)])].push_back(half);
    star_[at(m)].push_back(t);
    star_[at(m)].push_back(half);
  }
  return m;
}

// Nodes of the new vertex m, one for each group of the ring's simplices that hang together, -1 for
// a group that does not reach the surface. The ring is still unsplit.
std::vector<Index> SimplicialComplex::nodesOnEdge(Index p, Index q, Index m, double weight,
                                                  std::span<const Index> ring) {
  std::vector<Index> node(ring.size(), -1), stack;
  std::vector<char> seen(ring.size(), 0);
  const Vec3 rest = vertex(m);
  for (std::size_t seed = 0; seed < ring.size(); ++seed) {
    if (seen[seed]) continue;
    std::vector<std::size_t> group;
    Index slot = -1;
    stack.assign(1, static_cast<Index>(seed));
    seen[seed] = 1;
    while (!stack.empty()) {
      const auto k = at(stack.back());
      stack.pop_back();
      group.push_back(k);
      const Index t = ring[k];
      for (int i = 0; i < corners(); ++i) {
        const Index v = simplex(t)[corner(i)];
        if (v == p || v == q) continue;
        if (dimension_ == 3 && isFree({t, i})) slot = slot_[at(t)][corner(i)];
        if (dimension_ == 2) slot = t;
        if (isFree({t, i})) continue;
        const auto other = at(static_cast<Index>(
            std::lower_bound(ring.begin(), ring.end(), across({t, i})) - ring.begin()));
        if (seen[other]) continue;
        seen[other] = 1;
        stack.push_back(static_cast<Index>(other));
      }
    }
    if (slot < 0) continue;
    const NewSurfaceNode fresh{rest, -1, {nodeAt(slot, p), nodeAt(slot, q)}, weight};
    const Index added = addNode(m, fresh);
    for (const std::size_t k : group) node[k] = added;
  }
  return node;
}

void SimplicialComplex::splitSurface(Index p, Index q, Index m, double weight,
                                     std::span<const Index> ring, Index first) {
  const std::vector<Index> node = nodesOnEdge(p, q, m, weight, ring);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Index t = ring[k], half = first + static_cast<Index>(k);
    simplices_.push_back(Simplex(simplices_[at(t)]));
    across_.push_back(Slots(across_[at(t)]));
    slot_.push_back(Slots(slot_[at(t)]));
    const auto bisect = [&](Index slot, Facet owner) {
      Triangle part = triangles_[at(slot)];
      for (Index& n : part)
        if (nodeVertex(n) == p) n = node[k];
      replaceNode(slot, q, node[k]);
      return addTriangle(part, slot, isWall(slot), owner);
    };
    if (dimension_ == 2) {
      bisect(t, {half, 0});
      continue;
    }
    for (int i = 0; i < corners(); ++i) {
      const Index v = simplex(t)[corner(i)];
      if (v == p || v == q || !isFree({t, i})) continue;
      slot_[at(half)][corner(i)] = bisect(slot_[at(t)][corner(i)], {half, i});
    }
  }
}

// === Separating facets

void SimplicialComplex::setSlot(Facet f, Index slot) {
  slot_[at(f.simplex)][corner(f.corner)] = slot;
}

SimplicialComplex::Facet SimplicialComplex::otherSide(Facet f) const {
  const Index n = across(f);
  return {n, facetTo(n, f.simplex)};
}

void SimplicialComplex::labelStar(Index v, std::vector<Index>& labels) const {
  const auto around = star(v);
  labels.assign(around.size(), -1);
  std::vector<std::size_t> stack;
  Index count = 0;
  for (std::size_t seed = 0; seed < around.size(); ++seed) {
    if (labels[seed] >= 0) continue;
    stack.assign(1, seed);
    labels[seed] = count;
    while (!stack.empty()) {
      const Index t = around[stack.back()];
      stack.pop_back();
      for (int i = 0; i < corners(); ++i) {
        if (simplex(t)[corner(i)] == v || isFree({t, i})) continue;
        const auto other = static_cast<std::size_t>(
            std::find(around.begin(), around.end(), across({t, i})) - around.begin());
        if (labels[other] >= 0) continue;
        labels[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
}

// Turns about the edge vw through the solid from one free facet to the next.
SimplicialComplex::Facet SimplicialComplex::nextAround(Facet f, Index v, Index w) const {
  Index t = f.simplex;
  int from = f.corner;
  for (;;) {
    int to = 0;
    while (to == from || simplex(t)[corner(to)] == v || simplex(t)[corner(to)] == w) ++to;
    if (isFree({t, to})) return {t, to};
    const Index n = across({t, to});
    const int next = cornerOf(n, simplex(t)[corner(from)]);
    from = 0;
    while (from == next || simplex(n)[corner(from)] == v || simplex(n)[corner(from)] == w) ++from;
    t = n;
  }
}

std::vector<SimplicialComplex::Fan> SimplicialComplex::fansAt(Index v) const {
  std::vector<Fan> fans;
  if (dimension_ == 2) {
    std::vector<Index> labels;
    labelStar(v, labels);
    for (std::size_t k = 0; k < labels.size(); ++k) {
      if (at(labels[k]) >= fans.size()) fans.resize(at(labels[k]) + 1);
      fans[at(labels[k])].simplices.push_back(star(v)[k]);
    }
    return fans;
  }
  std::vector<Facet> free;
  for (const Index t : star(v))
    for (int i = 0; i < 4; ++i)
      if (simplex(t)[corner(i)] != v && isFree({t, i})) free.push_back({t, i});
  std::vector<char> seen(free.size(), 0);
  std::vector<std::size_t> stack;
  for (std::size_t seed = 0; seed < free.size(); ++seed) {
    if (seen[seed]) continue;
    Fan fan;
    stack.assign(1, seed);
    seen[seed] = 1;
    while (!stack.empty()) {
      const Facet f = free[stack.back()];
      stack.pop_back();
      fan.facets.push_back(f);
      for (const Index w : facetVertices(f)) {
        if (w == v) continue;
        const Facet n = nextAround(f, v, w);
        const auto k = static_cast<std::size_t>(
            std::find_if(free.begin(), free.end(),
                         [&](Facet g) { return g.simplex == n.simplex && g.corner == n.corner; }) -
            free.begin());
        if (seen[k]) continue;
        seen[k] = 1;
        stack.push_back(k);
      }
    }
    fans.push_back(std::move(fan));
  }
  return fans;
}

}  // namespace stroma
