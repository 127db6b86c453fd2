// SPDX-License-Identifier: Apache-2.0
// A liver and a stomach of plausible shape and adult size, for scenes with large soft bodies. x to
// the patient's left, y to the back, z up; metres.
#pragma once

#include "tools/mesh_maker/obj_file.h"

namespace stroma::meshes {

// Closed, 502 nodes, 1,000 triangles: a domed right lobe, a flat left lobe, a hollow underside and
// the notch between the lobes.
[[nodiscard]] GroupedMesh liver();

// Open at oesophagus (16 rim edges) and duodenum (17): 512 nodes, 991 triangles. A J-shaped bag
// with the fundus beside the oesophagus.
[[nodiscard]] GroupedMesh stomach();

}  // namespace stroma::meshes
