// SPDX-License-Identifier: Apache-2.0
// Particles in the cells of a regular lattice that fills a box, optionally jittered: the body of
// beams and test blocks. Each stands for its cell, so the volumes partition the box.
#pragma once

#include <cstdint>
#include <string>

#include "components/sampling/surface_mesh.h"

namespace stroma {

struct LatticeOptions {
  std::array<Index, 3> cells = {1, 1, 1};       // particles along x, y, z
  Vec3 min = Vec3::Zero(), max = Vec3::Ones();  // m
  double jitter = 0;  // every coordinate is moved by up to this share of the cell; below 0.5
  std::uint64_t seed = 1;
};

struct LatticeSamples {
  std::vector<Vec3> positions;  // x fastest, then y, then z (m)
  std::vector<double> volumes;  // m^3
  SurfaceMesh surface;          // the box, with the nodes of the cells on it
  double spacing = 0;           // cube root of a cell's volume (m)
  std::string problem;          // why there are no particles; empty when there are
};

[[nodiscard]] LatticeSamples sampleLattice(const LatticeOptions& options);

// The surface of a box whose faces are divided into the given numbers of cells, two triangles each.
[[nodiscard]] SurfaceMesh boxSurface(const std::array<Index, 3>& cells, const Vec3& min,
                                     const Vec3& max);

}  // namespace stroma
