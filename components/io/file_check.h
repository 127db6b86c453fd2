// SPDX-License-Identifier: Apache-2.0
// What is wrong with a PLY or STL file, found before a mesh library sees it. Libraries hang on some
// headers or allocate what they promise, take letters for zeros, and fill up what a file that was
// cut short lacks; these are strict. Binary coordinates are not looked at.
#pragma once

#include <optional>
#include <string_view>

#include "components/io/obj_records.h"

namespace stroma {

// The header must have known words only, and the file must hold just what the header promises: in
// text files a line of numbers for each element.
[[nodiscard]] std::optional<MeshProblem> plyProblem(std::string_view bytes);

// A text file must consist of facets of three vertices up to its endsolid, a binary one be as long
// as its number of triangles says.
[[nodiscard]] std::optional<MeshProblem> stlProblem(std::string_view bytes);

}  // namespace stroma
