// SPDX-License-Identifier: Apache-2.0
// Reads the solid that cutting keeps beside a surface: Gmsh 2.2, ASCII, triangles (the surface,
// outward) and tetrahedra. `stroma-mesh tetrahedra` writes such files.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "core/types.h"

namespace stroma {

struct TetrahedralFile {
  std::vector<Vec3> points;  // the surface's nodes first
  std::vector<Triangle> surface;
  std::vector<Tetrahedron> tetrahedra;
};

// Throws std::runtime_error that says what is wrong. Elements of other kinds are skipped; node
// numbers must run from 1.
[[nodiscard]] TetrahedralFile readTetrahedra(std::istream& in);
[[nodiscard]] TetrahedralFile readTetrahedra(const std::filesystem::path& file);

}  // namespace stroma
