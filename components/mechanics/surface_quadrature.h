// SPDX-License-Identifier: Apache-2.0
// Sample points of a closed, outward-oriented triangle mesh, fine enough for the particles beneath:
// every triangle is split evenly until no edge of a piece is longer than asked for (half the
// particles' spacing serves), and every piece is sampled at its centroid. Linear fields are
// integrated exactly, so sum A = 0 and sum X A^T = volume I. Each sample remembers its place in the
// mesh, so that loads given on nodes or triangles are integrated over the very same samples. SI.
#pragma once

#include "core/types.h"

namespace stroma {

struct SurfaceSample {
  Vec3 position;
  Vec3 area;       // outward vector area, m^2
  Index triangle;  // of the mesh
  Vec3 barycentric;
};

// maxEdge in m; 0 keeps the triangles whole.
[[nodiscard]] std::vector<SurfaceSample> sampleSurface(ConstVec3Span nodes,
                                                       std::span<const Triangle> triangles,
                                                       double maxEdge = 0);

}  // namespace stroma
