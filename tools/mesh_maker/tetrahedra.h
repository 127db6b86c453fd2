// SPDX-License-Identifier: Apache-2.0
// Fills triangle surfaces with tetrahedra, by netgen (Schoeberl 1997). The surface is kept: its
// nodes come first with their numbers and positions, its triangles are the boundary as they are;
// rims that are open get lids.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "core/types.h"

namespace stroma::meshes {

struct TetrahedralMesh {
  std::vector<Vec3> positions;  // [m]; the surface's nodes, then those inside
  std::vector<Triangle> surface;
  std::vector<Tetrahedron> tetrahedra;
  double smallestDihedral = 0;  // [degrees]
};

// `size`: largest edge inside, in mean edges of the surface; 0 leaves it to netgen. Throws
// std::runtime_error that says what is wrong: a file that cannot be read, a surface that is no
// sheet, or one that netgen cannot fill.
[[nodiscard]] TetrahedralMesh fillSurface(const std::filesystem::path& obj, double size);

// Gmsh 2.2, ASCII: nodes rounded to the nanometre, triangles, then tetrahedra.
void writeMsh(const TetrahedralMesh& mesh, std::ostream& out);

}  // namespace stroma::meshes
