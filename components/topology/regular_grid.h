// SPDX-License-Identifier: Apache-2.0
// A box of nx x ny x nz points with the corners `min` and `max` (m), numbered x fastest, then y,
// then z, as SOFA's RegularGridTopology numbers them. A direction with a single point lies at
// `min`; a grid without extent in some direction has no hexahedra and no surface.
#pragma once

#include <string>

#include "core/types.h"

namespace stroma {

struct RegularGrid {
  std::vector<Vec3> positions;
  std::vector<Hexahedron>
      hexahedra;                    // bottom face counter-clockwise seen from +z, then the top face
  std::vector<Quad> quads;          // the outer surface, facing outwards
  std::vector<Triangle> triangles;  // the same, each quad split in two
  std::vector<Edge> edges;          // along x, then y, then z
  std::vector<double> volumes;      // an eighth of the cells around each point (m^3)
  std::string problem;              // why there is no grid; empty when there is one
};

// How a grid's cells are made into tetrahedra that fit together, (b - a) x (c - a) towards d: six
// round the diagonal from node 0 to node 6 (Kuhn 1960), all cells alike; or five, one of them in
// the middle and four at corners, neighbouring cells mirrored.
enum class CellSplit { none, six, five };
[[nodiscard]] std::vector<Tetrahedron> splitCells(const std::array<Index, 3>& points,
                                                  std::span<const Hexahedron> cells,
                                                  CellSplit split);

[[nodiscard]] RegularGrid makeRegularGrid(const std::array<Index, 3>& points, const Vec3& min,
                                          const Vec3& max);

}  // namespace stroma
