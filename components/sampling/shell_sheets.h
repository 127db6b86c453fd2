// SPDX-License-Identifier: Apache-2.0
// Tells the two faces of a thin closed shell apart and pairs them through the thickness.
#pragma once

#include <string>

#include "components/sampling/surface_closing.h"

namespace stroma {

struct FoundSheets {
  ShellSheets sheets;
  double volume = 0;    // enclosed by the given surface (m^3)
  std::string problem;  // why no two sheets could be told apart; empty when they could
};

// Cuts the surface into patches along its creases (dihedral angle above `creaseAngle`, radians);
// the two largest are the sheets, the rest is the wall around them. The larger one is the outer
// sheet; its nodes are paired with the nearest points of the other sheet, rim with rim. Refuses
// what is no shell: fewer than two patches, sheets that do not face away from each other, a body as
// thick as it is wide.
[[nodiscard]] FoundSheets findSheets(ConstVec3Span positions, TriangleSpan triangles,
                                     double creaseAngle = 0.7);

}  // namespace stroma
