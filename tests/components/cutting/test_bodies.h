// SPDX-License-Identifier: Apache-2.0
// Bodies for tests of cutting, made from grids, and random blades.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "components/cutting/simplicial_complex.h"

namespace stroma::test {

struct TetrahedralMesh {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
};

// Box [0, size] of nx * ny * nz cells, six tetrahedra each; inner points moved by up to `jitter`
// cells.
TetrahedralMesh block(const Vec3& size, std::array<int, 3> cells, double jitter, unsigned seed);
// Cornea-like cap: anterior radius 7.8 mm, half-chord 5.65 mm, thickness 0.58 mm, axis z, apex at
// the origin.
TetrahedralMesh shell(int across, int layers);
// Ball of the given radius about the origin.
TetrahedralMesh ball(double radius, int cells);
// Open disk in the plane z = 0 or, with `bend`, on a sphere of that radius.
SimplicialComplex disk(double radius, int rings, double bend);

SimplicialComplex solid(const TetrahedralMesh& mesh);
// scenes/meshes/<name>.msh
SimplicialComplex sceneSolid(const std::string& name);

}  // namespace stroma::test
