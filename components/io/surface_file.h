// SPDX-License-Identifier: Apache-2.0
// Contents of surface mesh files.
#pragma once

#include <span>
#include <string>

#include "core/types.h"

namespace stroma {

enum class SurfaceFormat { obj, ply, stl };

// OBJ and PLY keep points, their order and all digits; STL (binary, single precision) keeps the
// triangles alone. Positions in metres.
[[nodiscard]] std::string surfaceFile(SurfaceFormat format, ConstVec3Span positions,
                                      std::span<const Triangle> triangles);

}  // namespace stroma
