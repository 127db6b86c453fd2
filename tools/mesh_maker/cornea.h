// SPDX-License-Identifier: Apache-2.0
// Corneas after the dimensions in the cornea paper (point-based deformation and cutting of cornea,
// section 4.1): anterior radius 7.8 mm, 11.8 mm wide and 10.8 mm high, 0.58 mm thick in the middle
// and 0.64 mm at the rim. Origin at the anterior apex, x horizontal, y vertical, z out of the eye.
#pragma once

#include "tools/mesh_maker/obj_file.h"

namespace stroma::meshes {

// The anterior surface alone: 192 nodes, 350 triangles, 32 rim edges, as many as in the paper.
[[nodiscard]] GroupedMesh corneaSheet();

// Closed: groups `anterior`, `posterior`, and `rim` for the wall between them, which stands
// perpendicular to the surface. `rings` of triangles from apex to rim.
[[nodiscard]] GroupedMesh corneaShell(int rings);

// The same with a circular outline of half-chord 5.65 mm and a uniform thickness of 0.58 mm, for
// comparison with axisymmetric solutions; smooth volume 63.866 mm^3.
[[nodiscard]] GroupedMesh corneaCap(int rings);

}  // namespace stroma::meshes
