// SPDX-License-Identifier: Apache-2.0
// Writes meshes as Wavefront OBJ, the same bytes on every run: positions in metres, rounded to the
// nanometre (far below any tissue's accuracy, far above rounding differences between machines).
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma::meshes {

struct Group {
  std::string name;
  std::vector<Triangle> triangles;
};

struct GroupedMesh {
  std::vector<std::string> comments;
  std::vector<Vec3> positions;
  std::vector<Group> groups;
};

void writeObj(const GroupedMesh& mesh, std::ostream& out);

// Boxes that contain the given nodes and no other node of the mesh, as the value of BoxROI's `box`:
// consecutive nodes share a box as long as that is possible. Micrometre grid, 5 um of margin at
// least.
[[nodiscard]] std::string boxesAround(std::span<const std::vector<Index>> chains,
                                      ConstVec3Span positions);

}  // namespace stroma::meshes
