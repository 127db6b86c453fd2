// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "components/sampling/blue_noise.h"
#include "components/sampling/point_grid.h"
#include "components/sampling/solid_scanner.h"
#include "core/random.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

TEST(SolidScanner, linesThroughEdgesAndVerticesCrossTheSurfaceOnce) {
  // every scanned line runs through mesh nodes and along mesh edges
  const SurfaceMesh box = shapes::box({0, 0, 0}, {1, 1, 1}, 5);
  const SolidScanner scanner(box.positions, box.triangles);
  std::vector<Interval> inside;
  for (int j = 1; j < 4; ++j)
    for (int k = 1; k < 4; ++k) {
      scanner.scan(0.25 * j, 0.25 * k, inside);
      ASSERT_EQ(inside.size(), 1u);
      EXPECT_DOUBLE_EQ(inside[0].begin, 0);
      EXPECT_DOUBLE_EQ(inside[0].end, 1);
    }
  // a rim line is either in or out, never half
  scanner.scan(0, 0.5, inside);
  EXPECT_LE(inside.size(), 1u);
}

TEST(SolidScanner, hollowAndSeparateBodiesAreSeenApart) {
  SurfaceMesh body = shapes::box({0, 0, 0}, {3, 3, 3});
  const SurfaceMesh hole = shapes::box({1, 1, 1}, {2, 2, 2});
  const auto offset = static_cast<Index>(body.positions.size());
  body.positions.insert(body.positions.end(), hole.positions.begin(), hole.positions.end());
  for (const Triangle& t : hole.triangles)
    body.triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  const SolidScanner scanner(body.positions, body.triangles);
  EXPECT_FALSE(scanner.isInside({1.5, 1.5, 1.5}));
  EXPECT_TRUE(scanner.isInside({0.5, 1.5, 1.5}));
  EXPECT_TRUE(scanner.isInside({2.5, 1.5, 1.5}));
  EXPECT_FALSE(scanner.isInside({3.5, 1.5, 1.5}));
  EXPECT_FALSE(scanner.isInside({1.5, 1.5, -0.5}));
}

TEST(SolidScanner, boundaryVoxelsCountWithTheirFraction) {
  const SurfaceMesh ball = shapes::ball(1, 33);
  const double volume = enclosedVolume(ball.positions, ball.triangles);
  const SolidScanner scanner(ball.positions, ball.triangles);
  for (const double cell : {0.2, 0.1, 0.05}) {
    const SolidSamples samples = scanner.samples(cell);
    const double error = shapes::sum(samples.volumes) / volume - 1;
    std::printf("cell %.2f: %zu samples, volume error %.2e\n", cell, samples.volumes.size(), error);
    // the lines that graze the ball limit the order to 1.5
    EXPECT_LT(std::abs(error), 0.1 * std::pow(cell, 1.5));
    for (const Vec3& p : samples.positions) ASSERT_TRUE(scanner.isInside(p));
  }
}

TEST(PointGrid, nearestIsTheNearestOfAll) {
  UniformRandom random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(random(), 0.1 * random(), 3 * random());
  for (const double bin : {0.003, 0.1, 10.0}) {
    const PointGrid grid(points, bin);
    for (int q = 0; q < 300; ++q) {
      const Vec3 p(3 * random() - 1, 3 * random() - 1, 5 * random() - 1);
      Index best = 0;
      for (Index i = 0; i < 500; ++i)
        if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm()) best = i;
      EXPECT_EQ(grid.nearest(p), best);
      EXPECT_EQ(grid.nearest(p, q), best);
    }
  }
}

TEST(PointGrid, withinFindsEveryPointOnce) {
  UniformRandom random(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) points.emplace_back(random(), random(), random());
  const PointGrid grid(points, 0.11);
  int expected = 0, found = 0;
  for (const Vec3& p : points) {
    for (const Vec3& q : points) expected += (p - q).norm() <= 0.25;
    grid.forEachWithin(p, 0.25, [&](Index, double) { ++found; });
  }
  EXPECT_EQ(found, expected);
}

TEST(BlueNoise, keepsTheWantedNumberAndItsDistance) {
  UniformRandom random(7);
  std::vector<Vec3> candidates;
  for (int i = 0; i < 5000; ++i) candidates.emplace_back(random(), random(), 0);
  const double packed = std::sqrt(1 / (2 * std::sqrt(3.0) * 1000));
  const std::vector<Index> picked = eliminateSamples(candidates, 1000, packed);
  ASSERT_EQ(picked.size(), 1000u);
  double closest = 1;
  for (std::size_t a = 0; a < picked.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      closest = std::min(closest, (candidates[picked[a]] - candidates[picked[b]]).norm());
  std::printf("closest pair / densest packing's: %.3f\n", closest / (2 * packed));
  EXPECT_GT(closest, 0.5 * 2 * packed);
}

}  // namespace
}  // namespace stroma
