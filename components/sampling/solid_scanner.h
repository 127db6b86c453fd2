// SPDX-License-Identifier: Apache-2.0
// The solid inside a closed surface, asked line by line: where a line along x enters and leaves it.
// The intervals are exact (to rounding), so volumes and inside tests need no voxel threshold: a
// voxel on the boundary counts with the part of its line that is inside. A line through an edge or
// a vertex of the mesh is decided as if moved by an infinitesimal amount, the same way for all
// triangles there (simulation of simplicity, Edelsbrunner & Muecke 1990), so it never counts a
// crossing twice or not at all. Where parts of the surface overlap, the solid is their union.
#pragma once

#include <array>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma {

struct Interval {
  double begin, end;
};

// Pieces of the solid small against its particles: midpoints, volumes (m^3), and the spacing of the
// scanned lines along y and z, so a sample is volume / (dy dz) long.
struct SolidSamples {
  std::vector<Vec3> positions;
  std::vector<double> volumes;
  double dy = 0, dz = 0;
};

class SolidScanner {
 public:
  // The surface must be closed and face outwards (whyNotClosed); copied.
  SolidScanner(ConstVec3Span positions, TriangleSpan triangles);

  // The parts of the line {(x, y, z) : all x} inside the solid, ascending, disjoint; into `out`.
  void scan(double y, double z, std::vector<Interval>& out) const;

  [[nodiscard]] bool isInside(const Vec3& point) const;

  // One sample for every voxel, of sides at most `cell`, whose middle line meets the solid.
  [[nodiscard]] SolidSamples samples(double cell) const;

 private:
  struct Crossing {
    double x;
    int sign;
  };

  void buildBins();
  [[nodiscard]] Index binOf(double coordinate, int axis) const;
  [[nodiscard]] int crossing(const Triangle& t, double y, double z, double& x) const;

  SurfaceMesh mesh_;
  Vec3 low_, high_;
  std::array<Index, 2> bins_{};        // along y and z
  std::array<double, 2> binSize_{};    // m
  std::vector<Index> start_, binned_;  // triangles of each bin
};

}  // namespace stroma
