// SPDX-License-Identifier: Apache-2.0
// Fills a thin shell with stacked columns of particles: in a column every particle has its
// neighbours straight above and below. Thin tissue needs this; in isotropic clouds of few layers
// the lateral offset of neighbours in the next layer passes for a thickness strain and locks
// bending.
//
// Columns are blue noise on the mid-surface, relaxed to the centroids of their Voronoi cells (Lloyd
// 1982). Each cell, a set of small prisms between the sheets, is cut into layers of equal
// thickness, with a particle near the middle of each: so far outwards that the particles have the
// second moment of their column, on which bending depends. Volumes are integrated exactly over the
// ruled prisms and scaled so that they partition the enclosed volume. Reproducible as the volume
// sampler is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/sampling/shell_sheets.h"

namespace stroma {

struct ShellSamplerOptions {
  Index count = 0;            // particles wanted: columns x layers
  Index layers = 3;           // through the thickness
  std::uint64_t seed = 1;     // of the blue noise
  int relaxations = 9;        // Lloyd steps
  int samplesPerColumn = 16;  // while relaxing; four times as many for the volumes
};

// Particle c * layers + k is the k-th from outside in column c.
struct ShellSamples {
  std::vector<Vec3> positions;      // m
  std::vector<double> volumes;      // m^3; their sum is the enclosed volume
  std::vector<Vec3> normals;        // unit, along the column, outwards
  std::vector<double> thicknesses;  // of the particle's layer (m)
  std::vector<Index> rim;  // particles of the columns whose cells touch an open rim, ascending
  Index columns = 0;
  double tangentialSpacing = 0;  // square root of mid-surface area per column (m)
  double layerSpacing = 0;       // mean thickness of a layer (m)
  std::string problem;           // why there are no particles; empty when there are
};

// A closed shell mesh whose sheets findSheets() can tell apart.
[[nodiscard]] ShellSamples sampleShell(ConstVec3Span positions, TriangleSpan triangles,
                                       const ShellSamplerOptions& options);

// Sheets that are known: an open sheet given a thickness (thickenSheet), for example. The volumes
// add up to `volume` (m^3).
[[nodiscard]] ShellSamples sampleShell(const ShellSheets& sheets, double volume,
                                       const ShellSamplerOptions& options);

}  // namespace stroma
