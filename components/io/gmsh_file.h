// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "components/io/mesh_file.h"

namespace stroma {

// Points, triangles and tetrahedra of a Gmsh file, format 2 (2.0 to 2.2), ASCII, in its order.
// Nodes may be numbered in any way. Its own points and lines are skipped, any other kind of element
// is a problem: a part of the body would be missing. Tetrahedra are turned so that (b - a) x (c -
// a) points to d; one without volume (6 V below 1e-12 of its longest edge cubed) is a problem.
// Never throws; what is wrong is told with its line.
[[nodiscard]] MeshData parseGmsh(std::string_view text);

}  // namespace stroma
