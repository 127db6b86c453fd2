// SPDX-License-Identifier: Apache-2.0
// Turns an open surface into a closed one, for sampling: by lids on its rims, or by giving it a
// thickness. The input must be a sheet as whyNotSheet() understands it.
#pragma once

#include "components/sampling/surface_mesh.h"

namespace stroma {

// The surface with a lid on every rim: a fan about one new node in the middle of the rim (weighted
// by the rim's edge lengths), appended after the given nodes and triangles.
[[nodiscard]] SurfaceMesh capRims(ConstVec3Span positions, TriangleSpan triangles);

// A thin shell as two sheets of the same triangles: inner[i] is straight below outer[i]. Triangles
// face outwards on the outer sheet.
struct ShellSheets {
  std::vector<Vec3> outer;
  std::vector<Vec3> inner;
  std::vector<Triangle> triangles;
};

// The given sheet as outer side, and its offset by `thickness` (m) against the nodal normals as
// inner side.
[[nodiscard]] ShellSheets thickenSheet(ConstVec3Span positions, TriangleSpan triangles,
                                       double thickness);

// The closed surface of a shell: outer nodes, then inner nodes; outer triangles, inner ones
// (turned), then a wall of two triangles along each rim edge.
[[nodiscard]] SurfaceMesh closeSheets(const ShellSheets& sheets);

}  // namespace stroma
