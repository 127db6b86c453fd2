// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/surface_mesh.h"

#include <algorithm>

namespace stroma {
namespace {

// Directed edges that have no opposite partner: the open rims.
std::vector<Edge> rimEdges(TriangleSpan triangles) {
  std::vector<Edge> directed;
  directed.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) directed.push_back({t[k], t[(k + 1) % 3]});
  std::sort(directed.begin(), directed.end());
  std::vector<Edge> rim;
  for (const Edge& e : directed)
    if (!std::binary_search(directed.begin(), directed.end(), Edge{e[1], e[0]})) rim.push_back(e);
  return rim;
}

}  // namespace

double surfaceArea(ConstVec3Span x, TriangleSpan triangles) {
  double area = 0;
  for (const Triangle& t : triangles) area += vectorArea(x, t).norm();
  return area;
}

std::vector<Vec3> nodalVectorAreas(ConstVec3Span x, TriangleSpan triangles) {
  std::vector<Vec3> areas(x.size(), Vec3::Zero());
  for (const Triangle& t : triangles) {
    const Vec3 third = vectorArea(x, t) / 3;
    for (const Index node : t) areas[node] += third;
  }
  return areas;
}

std::vector<Vec3> nodalNormals(ConstVec3Span x, TriangleSpan triangles) {
  std::vector<Vec3> normals = nodalVectorAreas(x, triangles);
  for (Vec3& n : normals)
    if (const double length = n.norm(); length > 0) n /= length;
  return normals;
}

std::vector<std::vector<Index>> boundaryLoops(TriangleSpan triangles) {
  const std::vector<Edge> rim = rimEdges(triangles);  // sorted by start node
  std::vector<bool> used(rim.size(), false);
  std::vector<std::vector<Index>> loops;
  const auto nextFrom = [&](Index node) {
    auto e = std::lower_bound(rim.begin(), rim.end(), Edge{node, 0});
    while (e != rim.end() && (*e)[0] == node && used[e - rim.begin()]) ++e;
    return e != rim.end() && (*e)[0] == node ? e : rim.end();
  };
  for (std::size_t first = 0; first < rim.size(); ++first) {
    if (used[first]) continue;
    std::vector<Index> loop;
    for (auto e = rim.begin() + static_cast<std::ptrdiff_t>(first); e != rim.end();
         e = nextFrom((*e)[1])) {
      used[e - rim.begin()] = true;
      loop.push_back((*e)[0]);
      if ((*e)[1] == loop.front()) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Edge> uniqueEdges(TriangleSpan triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace stroma
