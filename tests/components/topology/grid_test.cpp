// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "components/topology/element_check.h"
#include "components/topology/regular_grid.h"

namespace stroma {
namespace {

const Vec3& at(const RegularGrid& grid, Index i) {
  return grid.positions[static_cast<std::size_t>(i)];
}

TEST(RegularGrid, numbersPointsXFastest) {
  const RegularGrid grid = makeRegularGrid({3, 4, 5}, Vec3(0, 0, 0), Vec3(2, 6, 12));
  ASSERT_EQ(grid.positions.size(), 60u);
  EXPECT_EQ(at(grid, 1), Vec3(1, 0, 0));
  EXPECT_EQ(at(grid, 3), Vec3(0, 2, 0));
  EXPECT_EQ(at(grid, 12), Vec3(0, 0, 3));
  EXPECT_EQ(at(grid, 59), Vec3(2, 6, 12));
}

TEST(RegularGrid, countsFollowEuler) {
  const RegularGrid grid = makeRegularGrid({3, 4, 5}, Vec3::Zero(), Vec3::Ones());
  EXPECT_EQ(grid.hexahedra.size(), 2u * 3 * 4);
  EXPECT_EQ(grid.edges.size(), 2u * 4 * 5 + 3u * 3 * 5 + 3u * 4 * 4);
  EXPECT_EQ(grid.quads.size(), 2u * (2 * 3 + 3 * 4 + 2 * 4));
  EXPECT_EQ(grid.triangles.size(), 2 * grid.quads.size());
}

TEST(RegularGrid, volumesAddUpToTheBox) {
  const RegularGrid grid =
      makeRegularGrid({7, 5, 3}, Vec3(-0.01, 0, 0.002), Vec3(0.02, 0.01, 0.005));
  const double box = 0.03 * 0.01 * 0.003;
  const double sum = std::accumulate(grid.volumes.begin(), grid.volumes.end(), 0.0);
  std::printf("relative error of the volume %.2e\n", sum / box - 1);
  EXPECT_NEAR(sum / box, 1, 1e-13);
  // a corner has an eighth of a cell
  EXPECT_NEAR(grid.volumes.front(), box / (6 * 4 * 2) / 8, 1e-13 * box);
}

TEST(RegularGrid, surfaceIsClosedAndFacesOutwards) {
  const RegularGrid grid = makeRegularGrid({4, 3, 5}, Vec3(1, 2, 3), Vec3(2, 4, 3.5));
  Vec3 closing = Vec3::Zero();
  double volume = 0;
  for (const Triangle& t : grid.triangles) {
    const Vec3 area =
        0.5 * (at(grid, t[1]) - at(grid, t[0])).cross(at(grid, t[2]) - at(grid, t[0]));
    closing += area;
    volume += area.dot(at(grid, t[0])) / 3;
    EXPECT_GT(area.dot(at(grid, t[0]) - Vec3(1.5, 3, 3.25)), 0);
  }
  EXPECT_LT(closing.norm(), 1e-13);
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(RegularGrid, hexahedraAreRightHanded) {
  const RegularGrid grid = makeRegularGrid({3, 3, 3}, Vec3::Zero(), Vec3::Ones());
  for (const Hexahedron& h : grid.hexahedra) {
    const Vec3 x = at(grid, h[1]) - at(grid, h[0]), y = at(grid, h[3]) - at(grid, h[0]),
               z = at(grid, h[4]) - at(grid, h[0]);
    EXPECT_NEAR(x.cross(y).dot(z), 1.0 / 8, 1e-15);
  }
}

TEST(RegularGrid, tetrahedraFillTheCellsAndFitTogether) {
  const RegularGrid grid = makeRegularGrid({4, 3, 5}, Vec3::Zero(), Vec3(3, 2, 4));
  for (const auto& [split, each] : {std::pair{CellSplit::six, 6u}, {CellSplit::five, 5u}}) {
    const auto tetrahedra = splitCells({4, 3, 5}, grid.hexahedra, split);
    EXPECT_EQ(tetrahedra.size(), each * grid.hexahedra.size());
    double volume = 0;
    std::map<std::array<Index, 3>, int> sides;
    for (const Tetrahedron& t : tetrahedra) {
      const double six = (at(grid, t[1]) - at(grid, t[0]))
                             .cross(at(grid, t[2]) - at(grid, t[0]))
                             .dot(at(grid, t[3]) - at(grid, t[0]));
      EXPECT_GT(six, 0.5);
      volume += six / 6;
      for (std::size_t left = 0; left < 4; ++left) {
        std::array<Index, 3> side;
        for (std::size_t k = 0, to = 0; k < 4; ++k)
          if (k != left) side[to++] = t[k];
        std::ranges::sort(side);
        ++sides[side];
      }
    }
    EXPECT_NEAR(volume, 24, 1e-12);
    // a side belongs to two, but for those outside: two triangles a quad
    std::size_t outside = 0;
    for (const auto& [side, count] : sides) {
      EXPECT_LE(count, 2);
      outside += count == 1;
    }
    EXPECT_EQ(outside, grid.triangles.size());
  }
  EXPECT_TRUE(splitCells({4, 3, 5}, grid.hexahedra, CellSplit::none).empty());
}

TEST(ElementCheck, hexahedraShareTheirVolumeOut) {
  const RegularGrid grid = makeRegularGrid({3, 4, 3}, Vec3::Zero(), Vec3(1, 2, 3));
  const auto volumes = lumpedVolumes(grid.positions, grid.hexahedra);
  for (std::size_t i = 0; i < volumes.size(); ++i) EXPECT_NEAR(volumes[i], grid.volumes[i], 1e-14);
  // x -> (x, y, z (1 + x y)): the top is a bilinear patch, the volume 1 + 1/4
  std::vector<Vec3> warped{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                           {0, 0, 1}, {1, 0, 1}, {1, 1, 2}, {0, 1, 1}};
  const std::vector<Hexahedron> one{{0, 1, 2, 3, 4, 5, 6, 7}};
  double sum = 0;
  for (const double v : lumpedVolumes(warped, one)) sum += v;
  EXPECT_NEAR(sum, 1.25, 1e-14);
}

TEST(RegularGrid, saysWhatIsWrong) {
  EXPECT_FALSE(makeRegularGrid({0, 2, 2}, Vec3::Zero(), Vec3::Ones()).problem.empty());
  EXPECT_FALSE(makeRegularGrid({2, 2, 2}, Vec3::Ones(), Vec3::Zero()).problem.empty());
  EXPECT_FALSE(makeRegularGrid({2000000, 2000000, 2}, Vec3::Zero(), Vec3::Ones()).problem.empty());
  EXPECT_TRUE(makeRegularGrid({5, 5, 1}, Vec3::Zero(), Vec3::Ones()).problem.empty());
}

TEST(ElementCheck, namesTheFirstBadElement) {
  const std::vector<Triangle> good{{0, 1, 2}, {2, 1, 3}}, outside{{0, 1, 2}, {2, 1, 4}},
      twice{{0, 1, 1}};
  EXPECT_EQ(elementProblem(std::span(good), 4), "");
  EXPECT_EQ(elementProblem(std::span(outside), 4),
            "element 1 (2 1 4) uses point 4; there are 4 points");
  EXPECT_EQ(elementProblem(std::span(twice), 4), "element 0 (0 1 1) uses point 1 twice");
}

TEST(ElementCheck, tetrahedraShareTheirVolume) {
  const std::vector<Vec3> x{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const std::vector<Tetrahedron> cells{{0, 1, 2, 3}};
  for (const double v : lumpedVolumes(x, cells)) EXPECT_NEAR(v, 1.0 / 24, 1e-16);
}

}  // namespace
}  // namespace stroma
