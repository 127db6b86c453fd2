// SPDX-License-Identifier: Apache-2.0
// Small bodies of elements for the tests, and fields on them.
#pragma once

#include <random>

#include "components/fem/element_elasticity.h"
#include "components/topology/regular_grid.h"

namespace stroma::test {

inline std::vector<Vec3> randomField(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> field(count);
  for (Vec3& v : field)
    for (int c = 0; c < 3; ++c) v[c] = uniform(random);
  return field;
}

inline Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline double norm(ConstVec3Span a) { return flat(a).norm(); }

// A grid of cells of size 1 whose nodes inside are moved, as elements of one kind.
template <class Element>
struct Body {
  RegularGrid grid;
  std::vector<Vec3> rest;
  std::vector<bool> inside;
  ElementMesh<Element> mesh;

  explicit Body(const std::array<Index, 3>& cells, double jitter = 0.15)
      : Body(makeRegularGrid(pointsOf(cells), Vec3::Zero(), Vec3(cells[0], cells[1], cells[2])),
             pointsOf(cells), jitter) {}

  static std::vector<std::array<Index, Element::nodes>> elements(
      const RegularGrid& grid, const std::array<Index, 3>& points) {
    if constexpr (Element::nodes == 4)
      return splitCells(points, grid.hexahedra, CellSplit::six);
    else
      return grid.hexahedra;
  }

  // The rest positions, deformed by A and then moved at random.
  [[nodiscard]] std::vector<Vec3> moved(const Mat3& A, double noise, unsigned seed = 3) const {
    std::vector<Vec3> x = randomField(rest.size(), noise, seed);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += A * rest[i] + Vec3(0.3, -5, 2);
    return x;
  }

 private:
  static std::array<Index, 3> pointsOf(const std::array<Index, 3>& cells) {
    return {cells[0] + 1, cells[1] + 1, cells[2] + 1};
  }
  Body(RegularGrid made, const std::array<Index, 3>& points, double jitter)
      : grid(std::move(made)),
        rest(randomField(grid.positions.size(), jitter, 1)),
        inside(rest.size()),
        mesh(place(points), elements(grid, points)) {}
  ConstVec3Span place(const std::array<Index, 3>& points) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const Vec3& X = grid.positions[i];
      bool in = true;
      for (int c = 0; c < 3; ++c) in &= X[c] > 0.5 && X[c] < points[c] - 1.5;
      inside[i] = in;
      rest[i] = in ? Vec3(rest[i] + X) : X;
    }
    return rest;
  }
};

}  // namespace stroma::test
