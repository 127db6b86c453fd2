// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "components/sampling/surface_check.h"
#include "components/sampling/surface_closing.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

int count(const std::vector<SurfaceFinding>& findings, SurfaceFault fault) {
  int n = 0;
  for (const SurfaceFinding& f : findings) n += f.fault == fault;
  return n;
}

TEST(SurfaceMesh, volumeOfABoxIsExactWhereverItIs) {
  const SurfaceMesh near = shapes::box({0, 0, 0}, {1, 2, 3}, 4);
  const SurfaceMesh far = shapes::box({1000, 1000, 1000}, {1001, 1002, 1003}, 4);
  EXPECT_NEAR(enclosedVolume(near.positions, near.triangles), 6, 1e-13);
  EXPECT_NEAR(enclosedVolume(far.positions, far.triangles), 6, 1e-9);
  EXPECT_NEAR(surfaceArea(near.positions, near.triangles), 22, 1e-12);
}

TEST(SurfaceMesh, nodalVectorAreasOfAClosedSurfaceSumToZero) {
  const SurfaceMesh ball = shapes::ball(0.02);
  Vec3 total = Vec3::Zero();
  for (const Vec3& a : nodalVectorAreas(ball.positions, ball.triangles)) total += a;
  const double area = surfaceArea(ball.positions, ball.triangles);
  std::printf("sum of vector areas / area: %.2e\n", total.norm() / area);
  EXPECT_LT(total.norm(), 1e-14 * area);
}

TEST(SurfaceMesh, nodalVectorAreasAreTheVolumeGradient) {
  SurfaceMesh ball = shapes::ball(1, 5);
  const std::vector<Vec3> areas = nodalVectorAreas(ball.positions, ball.triangles);
  const double h = 1e-4;
  for (const std::size_t node : {std::size_t{0}, std::size_t{17}, std::size_t{40}})
    for (int d = 0; d < 3; ++d) {
      ball.positions[node][d] += h;
      const double above = enclosedVolume(ball.positions, ball.triangles);
      ball.positions[node][d] -= 2 * h;
      const double below = enclosedVolume(ball.positions, ball.triangles);
      ball.positions[node][d] += h;
      EXPECT_NEAR((above - below) / (2 * h), areas[node][d], 1e-10);
    }
}

TEST(SurfaceMesh, boundaryLoopOfASheetIsItsWholeRim) {
  const SurfaceMesh sheet = shapes::sheet(1, 0.1, 5);
  const auto loops = boundaryLoops(sheet.triangles);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 16u);
  EXPECT_EQ(loops[0][0], 0);
  EXPECT_EQ(loops[0][1], 1);  // counter-clockwise seen from outside
  EXPECT_TRUE(boundaryLoops(shapes::ball(1, 4).triangles).empty());
}

TEST(SurfaceCheck, soundSurfacesHaveNoFindings) {
  const SurfaceMesh ball = shapes::ball(1);
  EXPECT_TRUE(checkSurface(ball.positions, ball.triangles).empty());
  EXPECT_EQ(whyNotClosed(ball.positions, ball.triangles), "");
  const SurfaceMesh sheet = shapes::sheet(1, 0.1);
  EXPECT_EQ(whyNotSheet(sheet.positions, sheet.triangles), "");
}

TEST(SurfaceCheck, emptyMeshesAreFound) {
  const auto none = checkSurface({}, {});
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(none[0].fault, SurfaceFault::empty);
  EXPECT_EQ(whyNotClosed({}, {}), "the mesh has no vertex");
}

TEST(SurfaceCheck, eachFaultIsFoundWhereItIs) {
  const SurfaceMesh sound = shapes::box({0, 0, 0}, {1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();

  SurfaceMesh m = sound;
  m.positions[3][1] = nan;
  auto found = checkSurface(m.positions, m.triangles);
  ASSERT_EQ(count(found, SurfaceFault::nonFinitePosition), 1);
  EXPECT_EQ(found[0].vertices[0], 3);

  m = sound;
  m.triangles[5][2] = 8;
  found = checkSurface(m.positions, m.triangles);
  ASSERT_EQ(count(found, SurfaceFault::indexOutOfRange), 1);
  EXPECT_EQ(found[0].text, "triangle 5 uses vertex 8, the mesh has vertices 0 to 7");
  m.triangles[5][2] = -1;
  EXPECT_EQ(count(checkSurface(m.positions, m.triangles), SurfaceFault::indexOutOfRange), 1);

  m = sound;
  m.triangles.pop_back();
  found = checkSurface(m.positions, m.triangles);
  EXPECT_EQ(count(found, SurfaceFault::openRim), 3);
  EXPECT_NE(whyNotClosed(m.positions, m.triangles).find("open rim"), std::string::npos);
  EXPECT_EQ(whyNotSheet(m.positions, m.triangles), "");

  m = sound;
  std::swap(m.triangles[0][1], m.triangles[0][2]);
  EXPECT_EQ(count(checkSurface(m.positions, m.triangles), SurfaceFault::inconsistentOrientation),
            3);

  m = sound;
  m.positions.emplace_back(2, 2, 2);
  found = checkSurface(m.positions, m.triangles);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text, "vertex 8 belongs to no triangle");
  EXPECT_EQ(whyNotClosed(m.positions, m.triangles), "");

  m.triangles.push_back({m.triangles[0][0], m.triangles[0][1], 8});
  EXPECT_EQ(count(checkSurface(m.positions, m.triangles), SurfaceFault::nonManifoldEdge), 1);

  m = sound;
  for (Triangle& t : m.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(count(checkSurface(m.positions, m.triangles), SurfaceFault::insideOut), 1);

  m = sound;
  for (Vec3& p : m.positions) p[2] = 0;
  found = checkSurface(m.positions, m.triangles);
  EXPECT_EQ(count(found, SurfaceFault::zeroArea), 8);
  EXPECT_EQ(count(found, SurfaceFault::noVolume), 1);

  m = sound;
  m.triangles[7][1] = m.triangles[7][0];
  EXPECT_EQ(count(checkSurface(m.positions, m.triangles), SurfaceFault::repeatedVertex), 1);
}

TEST(SurfaceClosing, lidsCloseAndKeepTheOrientation) {
  const SurfaceMesh sheet = shapes::sheet(2, 0.5);
  const SurfaceMesh closed = capRims(sheet.positions, sheet.triangles);
  EXPECT_EQ(closed.positions.size(), sheet.positions.size() + 1);
  // the sheet bulges out of its lid
  EXPECT_TRUE(checkSurface(closed.positions, closed.triangles).empty());
}

TEST(SurfaceClosing, thickenedSheetHasAreaTimesThickness) {
  const SurfaceMesh flat = shapes::sheet(2, 0);
  const SurfaceMesh slab = closeSheets(thickenSheet(flat.positions, flat.triangles, 0.1));
  EXPECT_TRUE(checkSurface(slab.positions, slab.triangles).empty());
  EXPECT_NEAR(enclosedVolume(slab.positions, slab.triangles), 0.4, 1e-14);
  const SurfaceMesh bent = shapes::sheet(2, 0.4, 41);
  const SurfaceMesh shell = closeSheets(thickenSheet(bent.positions, bent.triangles, 0.02));
  EXPECT_TRUE(checkSurface(shell.positions, shell.triangles).empty());
  const double expected = 0.02 * surfaceArea(bent.positions, bent.triangles);
  EXPECT_NEAR(enclosedVolume(shell.positions, shell.triangles) / expected, 1, 0.02);
}

}  // namespace
}  // namespace stroma
