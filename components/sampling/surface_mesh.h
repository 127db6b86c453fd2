// SPDX-License-Identifier: Apache-2.0
// Measures of triangle surfaces. A surface is (positions in metres, triangles of position indices),
// triangles counter-clockwise seen from outside. Functions here expect valid indices and finite
// positions; surface_check.h says whether a mesh from a file has them. The volume inside is
// enclosedVolume in core/triangle.h.
#pragma once

#include <span>
#include <vector>

#include "core/triangle.h"

namespace stroma {

struct SurfaceMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

using TriangleSpan = std::span<const Triangle>;

// Half the cross product of two edges (m^2): area times unit normal.
[[nodiscard]] inline Vec3 vectorArea(ConstVec3Span x, const Triangle& t) {
  return 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
}

[[nodiscard]] double surfaceArea(ConstVec3Span positions, TriangleSpan triangles);

// A third of the vector areas of the triangles around each node (m^2). They sum to zero on a closed
// surface; pressure times the nodal vector area is the consistent nodal force.
[[nodiscard]] std::vector<Vec3> nodalVectorAreas(ConstVec3Span positions, TriangleSpan triangles);

// Unit normals at the nodes, weighted by area; zero where a node has no triangle.
[[nodiscard]] std::vector<Vec3> nodalNormals(ConstVec3Span positions, TriangleSpan triangles);

// Open rims as closed chains of nodes, each in the direction in which its triangles run along it,
// so the surface lies to the left seen from outside. Loops start at their smallest node, in order
// of it. Where several rims touch in one node, they are walked apart, each edge once.
[[nodiscard]] std::vector<std::vector<Index>> boundaryLoops(TriangleSpan triangles);

// The undirected edges (smaller node first), sorted, each once.
[[nodiscard]] std::vector<Edge> uniqueEdges(TriangleSpan triangles);

}  // namespace stroma
