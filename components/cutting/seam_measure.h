// SPDX-License-Identifier: Apache-2.0
// How long and how smooth an incision is where it meets the surface.
#pragma once

#include <vector>

#include "components/cutting/simplicial_complex.h"

namespace stroma {

// The lines along which cuts meet the surface (dimension 3: where walls meet the uncut surface;
// dimension 2: the separated edges), each as a chain of points, longest first. Lines end where they
// branch. A closed line repeats its first point.
[[nodiscard]] std::vector<std::vector<Vec3>> seamLines(const SimplicialComplex& complex);

[[nodiscard]] double lineLength(ConstVec3Span line);

struct Smoothness {
  double meanTurning = 0;    // angle between successive segments, mean over inner points [rad]
  double meanDeviation = 0;  // of the points from the path, in units of `edge`
};
// `path`: the true line, as a polyline. `edge`: mean edge length of the uncut mesh [m].
[[nodiscard]] Smoothness smoothness(ConstVec3Span line, ConstVec3Span path, double edge);

}  // namespace stroma
