// SPDX-License-Identifier: Apache-2.0
// What a mesh library forgets of a Wavefront OBJ file: the points as the file numbers them, in full
// precision, and which of them each corner of each face names. Libraries keep a copy of a point for
// every corner, in single precision; this finds the points again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"

namespace stroma {

struct MeshProblem {
  std::string message;
  int line = 0;  // of the mesh file, 0 where it is not known
};

struct ObjRecords {
  std::vector<Vec3> points;           // the `v` records
  std::vector<Index> corners;         // points of all faces and lines, as they follow each other
  std::vector<MeshProblem> problems;  // bad numbers, indices that name no point; at most 20
};

// Never throws for bad files: a record that cannot be read is a problem with its line.
[[nodiscard]] ObjRecords scanObj(std::string_view text);

}  // namespace stroma
