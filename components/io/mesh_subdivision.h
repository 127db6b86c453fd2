// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/io/mesh_file.h"

namespace stroma {

// Splits every triangle into four at the middles of its edges. The surface stays where it is;
// points keep their numbers, new ones follow; triangle t becomes 4t to 4t + 3, in the same groups.
void subdivide(MeshData& mesh);

}  // namespace stroma
