// SPDX-License-Identifier: Apache-2.0
// Surfaces with known measures, for the tests of the sampling module.
#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "components/sampling/surface_closing.h"

namespace stroma::shapes {

// n x n nodes on each face, shared along the edges.
inline SurfaceMesh box(const Vec3& min, const Vec3& max, Index n = 2) {
  SurfaceMesh mesh;
  std::map<std::array<Index, 3>, Index> number;
  const auto node = [&](const std::array<Index, 3>& at) {
    const auto [entry, isNew] = number.try_emplace(at, static_cast<Index>(number.size()));
    if (isNew)
      mesh.positions.emplace_back(min +
                                  Vec3(at[0], at[1], at[2]).cwiseProduct(max - min) / (n - 1));
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true})
      for (Index b = 0; b + 1 < n; ++b)
        for (Index a = 0; a + 1 < n; ++a) {
          const auto corner = [&](Index da, Index db) {
            std::array<Index, 3> at{};
            at[axis] = far ? n - 1 : 0;
            at[(axis + 1) % 3] = a + da;
            at[(axis + 2) % 3] = b + db;
            return node(at);
          };
          const Index p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          mesh.triangles.push_back(far ? Triangle{p, q, r} : Triangle{p, r, q});
          mesh.triangles.push_back(far ? Triangle{p, r, s} : Triangle{p, s, r});
        }
  return mesh;
}

// A cube's surface blown up to a ball.
inline SurfaceMesh ball(double radius, Index n = 17) {
  SurfaceMesh mesh = box(Vec3::Constant(-1), Vec3::Constant(1), n);
  for (Vec3& p : mesh.positions) p *= radius / p.norm();
  return mesh;
}

// An open, curved, rectangular sheet, n x n nodes, bulging along z.
inline SurfaceMesh sheet(double width, double bulge, Index n = 13) {
  SurfaceMesh mesh;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const double x = static_cast<double>(i) / (n - 1) - 0.5;
      const double y = static_cast<double>(j) / (n - 1) - 0.5;
      mesh.positions.emplace_back(width * x, width * y, bulge * (1 - 2 * (x * x + y * y)));
    }
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = i + n * j;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a, a + n + 1, a + n});
    }
  return mesh;
}

inline double sum(const std::vector<double>& values) {
  // compensated, so that the test's own rounding stays out of the figure
  double total = 0, lost = 0;
  for (const double v : values) {
    const double y = v - lost, t = total + y;
    lost = (t - total) - y;
    total = t;
  }
  return total;
}

}  // namespace stroma::shapes
