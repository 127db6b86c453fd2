// SPDX-License-Identifier: Apache-2.0
// What must be true of a body's surface however it has been cut. O(surface + simplices): for tests
// and for checking after every step on demand.
#pragma once

#include <string>
#include <vector>

#include "components/cutting/simplicial_complex.h"

namespace stroma {

struct PieceNumbers {
  Index nodes = 0, edges = 0, triangles = 0, rimEdges = 0;
  [[nodiscard]] Index euler() const { return nodes - edges + triangles; }
};

struct SurfaceNumbers {
  double area = 0;              // [m^2]
  double volume = 0;            // enclosed by the surface [m^3]; 0 for an open sheet
  double openness = 0;          // |sum of area vectors| / area; 0 for an open sheet
  double volumeMismatch = 0;    // |surface's volume - volume of the simplices| / volume
  double smallestAngle = 0;     // [degrees]
  double sliverFraction = 0;    // triangles with an angle below 5 degrees
  double smallestTriangle = 0;  // shortest height / mean edge length
  Index walls = 0;
  std::vector<PieceNumbers> pieces;
  std::vector<std::string> failures;
  [[nodiscard]] Index euler() const;
};

// Checks: every edge has two triangles of opposite direction (an open sheet's rim one), every node
// has one fan, F = 2V - 2chi - B for each piece, closedness <= 1e-12 A, the volume enclosed agrees
// with the simplices' and with `volume` (if positive) to 1e-12, no two triangles on the same nodes,
// none lower than 1e-9 of the mean edge, the two walls of every cut facet on the same three points.
[[nodiscard]] SurfaceNumbers checkInvariants(const SimplicialComplex& complex, double volume = 0);

// FNV-1a of all connectivity and positions: equal for equal bodies, bit by bit.
[[nodiscard]] std::uint64_t topologyHash(const SimplicialComplex& complex);

}  // namespace stroma
