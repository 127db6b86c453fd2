// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/lattice.h"

#include <gtest/gtest.h>

#include "components/sampling/surface_check.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

TEST(Lattice, volumesPartitionTheBoxAndTheSurfaceEnclosesIt) {
  const LatticeSamples s = sampleLattice({.cells = {4, 5, 6}, .min = {-1, 0, 2}, .max = {1, 1, 5}});
  ASSERT_EQ(s.problem, "");
  ASSERT_EQ(s.positions.size(), 120u);
  EXPECT_NEAR(shapes::sum(s.volumes), 6, 1e-12);
  EXPECT_EQ(whyNotClosed(s.surface.positions, s.surface.triangles), "");
  EXPECT_NEAR(enclosedVolume(s.surface.positions, s.surface.triangles), 6, 1e-12);
  EXPECT_NEAR((s.positions[0] - Vec3(-0.75, 0.1, 2.25)).norm(), 0, 1e-15);
  EXPECT_NEAR((s.positions[1] - s.positions[0] - Vec3(0.5, 0, 0)).norm(), 0, 1e-15);  // x fastest
}

TEST(Lattice, jitterStaysInsideTheCellAndIsReproducible) {
  const LatticeOptions options{.cells = {5, 5, 5}, .max = {5, 5, 5}, .jitter = 0.4, .seed = 2};
  const LatticeSamples a = sampleLattice(options), b = sampleLattice(options);
  EXPECT_EQ(a.positions, b.positions);
  double farthest = 0;
  for (Index i = 0; i < 125; ++i) {
    const Vec3 center(i % 5 + 0.5, i / 5 % 5 + 0.5, i / 25 + 0.5);
    farthest = std::max(farthest, (a.positions[i] - center).cwiseAbs().maxCoeff());
  }
  std::printf("farthest coordinate from the cell's middle: %.3f cells\n", farthest);
  EXPECT_LE(farthest, 0.4);
  EXPECT_GT(farthest, 0.35);
}

TEST(Lattice, whatIsNoBoxIsAnswered) {
  EXPECT_NE(sampleLattice({.cells = {0, 1, 1}}).problem, "");
  EXPECT_NE(sampleLattice({.cells = {100000, 100000, 100000}}).problem, "");
  EXPECT_NE(sampleLattice({.max = {1, 0, 1}}).problem, "");
  EXPECT_NE(sampleLattice({.jitter = 0.5}).problem, "");
}

}  // namespace
}  // namespace stroma
