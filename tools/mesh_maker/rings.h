// SPDX-License-Identifier: Apache-2.0
// Triangle bands between rings of nodes. Rings are numbered one after the other; node i of a ring
// of n nodes with shift s lies at the angle 2 pi (i + s) / n.
#pragma once

#include <span>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma::meshes {

struct Ring {
  Index first;       // number of its node 0
  Index count;       // nodes
  double shift = 0;  // of node 0, in steps
};

// Angle of a node as a share of the full turn.
[[nodiscard]] inline double turn(const Ring& ring, Index node) {
  return (node + ring.shift) / ring.count;
}

// The band between two rings: inner.count + outer.count triangles, counter-clockwise seen from the
// side from which angles run counter-clockwise and `inner` lies inside `outer`.
void addBand(const Ring& inner, const Ring& outer, std::vector<Triangle>& triangles);

// The fan of a ring about a node in its middle, seen as above.
void addFan(Index middle, const Ring& ring, std::vector<Triangle>& triangles);

// Consecutive rings with the given node counts; the first node has number `first`. Every other ring
// is shifted by half a step when `staggered`.
[[nodiscard]] std::vector<Ring> makeRings(std::span<const Index> counts, Index first,
                                          bool staggered);

// `total` nodes shared out in proportion to the weights (largest remainders get the rest).
[[nodiscard]] std::vector<Index> shareOut(Index total, std::span<const double> weights);

}  // namespace stroma::meshes
