// SPDX-License-Identifier: Apache-2.0
// A grid of cells of size 1 as tetrahedra, and particles to project.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "components/topology/regular_grid.h"
#include "components/xpbd/tetrahedron_pairs.h"

namespace stroma::test {

inline std::vector<Vec3> randomField(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> field(count);
  for (Vec3& v : field)
    for (int c = 0; c < 3; ++c) v[c] = uniform(random);
  return field;
}

// `edges` from node 0 as columns.
inline TetrahedronPair<double> makePair(const Mat3& edges, const Mat3& restInverse) {
  TetrahedronPair<double>::Vectors e, b;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) e[a][i] = edges(i, a), b[a][i] = restInverse(a, i);
  return {e, b};
}
inline Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

struct PairBody {
  std::vector<Vec3> rest, x, start;
  std::vector<Tetrahedron> elements;
  std::vector<double> inverseMass;
  TetrahedronPairs pairs;

  explicit PairBody(Index cells) : PairBody(std::array{cells + 1, cells + 1, cells + 1}) {}

  XpbdParticles particles(double h) { return {x, start, inverseMass, {}, h}; }
  std::uint64_t project(double h, double damping = 0) {
    return pairs.project(particles(h), damping);
  }
  [[nodiscard]] TetrahedronPair<double> pairOf(const Tetrahedron& t, ConstVec3Span at) const {
    return makePair(edges(at, t), edges(rest, t).inverse());
  }
  [[nodiscard]] double volumeOf(const Tetrahedron& t) const {
    return edges(rest, t).determinant() / 6;
  }
  [[nodiscard]] double smallestRatio() const {
    double least = 1e300;
    for (const Tetrahedron& t : elements) least = std::min(least, pairOf(t, x).volume);
    return least;
  }
  [[nodiscard]] double largestMove(ConstVec3Span from) const {
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - from[i]).norm());
    return most;
  }

 private:
  explicit PairBody(const std::array<Index, 3>& points)
      : PairBody(points, makeRegularGrid(points, Vec3::Zero(),
                                         Vec3(points[0] - 1, points[1] - 1, points[2] - 1))) {}
  PairBody(const std::array<Index, 3>& points, const RegularGrid& grid)
      : rest(grid.positions),
        x(rest),
        start(rest),
        elements(splitCells(points, grid.hexahedra, CellSplit::six)),
        inverseMass(rest.size()),
        pairs(rest, elements) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.2, 2);
    for (double& w : inverseMass) w = uniform(random);
  }
  static Mat3 edges(ConstVec3Span at, const Tetrahedron& t) {
    const auto point = [&](int a) { return at[static_cast<std::size_t>(t[a])]; };
    Mat3 edges;
    for (int a = 1; a < 4; ++a) edges.col(a - 1) = point(a) - point(0);
    return edges;
  }
};

}  // namespace stroma::test
