// SPDX-License-Identifier: Apache-2.0
// Fills a closed surface with a wanted number of particles: blue noise, relaxed towards a
// centroidal Voronoi tessellation (Lloyd 1982), each particle standing for its Voronoi cell cut to
// the solid. Volumes are the partition of the enclosed volume by these cells, never a kernel sum,
// which over-counts at every surface. Cells are integrated over small samples of the solid whose
// boundary ones count with the part that is inside.
//
// The same surface, options and seed give the same bits at any number of threads and on every
// machine that rounds as IEEE 754 says (the module is built without contraction to fused
// operations).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma {

struct VolumeSamplerOptions {
  Index count = 0;          // particles wanted, at least 1
  std::uint64_t seed = 1;   // of the blue noise
  int relaxations = 10;     // Lloyd steps
  int samplesPerCell = 64;  // while relaxing; four times as many for the volumes
  bool moments = false;     // fill secondMoments
};

struct VolumeSamples {
  std::vector<Vec3> positions;  // cell centroids (m)
  std::vector<double> volumes;  // m^3; their sum is the enclosed volume
  double spacing = 0;           // cube root of the mean volume (m)
  std::vector<Vec3> centroids;  // of the cells (m): the positions, unless one had to move inside
  std::vector<Mat3> secondMoments;  // mean of (X - centroid)(X - centroid)^T over the cell (m^2)
  Index movedInside = 0;            // particles whose cell's centroid lay outside the solid
  std::string problem;              // why there are no particles; empty when there are
};

[[nodiscard]] VolumeSamples sampleVolume(ConstVec3Span positions, TriangleSpan triangles,
                                         const VolumeSamplerOptions& options);

}  // namespace stroma
