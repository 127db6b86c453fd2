// SPDX-License-Identifier: Apache-2.0
// What is odd about a mesh that a file gave. Bad indices and coordinates make it unusable;
// the rest is for the user to know, since only who needs a closed or manifold surface can object.
#pragma once

#include <string>
#include <vector>

#include "components/io/mesh_file.h"

namespace stroma {

struct MeshRemark {
  bool unusable;
  std::string id;  // "mesh-empty", "mesh-coordinate", "mesh-degenerate", ...
  std::string message;
};

// One remark for each kind, naming the first case and how many there are. A triangle is degenerate
// when two of its points are one, or its area is below 1e-12 of its longest edge squared.
[[nodiscard]] std::vector<MeshRemark> checkMesh(const MeshData& mesh);

// Whether the size (m) is no tissue's: over 10 m or below 10 um. Empty when it is.
[[nodiscard]] std::string sizeRemark(ConstVec3Span positions);

}  // namespace stroma
