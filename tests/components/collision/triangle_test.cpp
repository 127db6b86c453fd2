// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "components/collision/contact_point.h"
#include "components/collision/triangle_geometry.h"
#include "core/surface_links.h"
#include "tests/components/collision/random_surface.h"

namespace stroma::test {
namespace {

Vec3 randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

TEST(Triangle, nearestPointIsNoFartherThanAnyOther) {
  std::mt19937 random(1);
  for (int k = 0; k < 500; ++k) {
    const Corners t{randomPoint(random), randomPoint(random), randomPoint(random)};
    const Vec3 p = 2 * randomPoint(random);
    const TrianglePoint near = nearestOnTriangle(t, p);
    EXPECT_NEAR(near.weights.sum(), 1, 1e-12);
    EXPECT_GE(near.weights.minCoeff(), 0);
    EXPECT_NEAR((t.at(near.weights) - near.point).norm(), 0, 1e-15);
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 other = t.at(Vec3(i, j, 20 - i - j) / 20);
        EXPECT_LE(near.distance2, (p - other).squaredNorm() + 1e-14);
      }
    }
  }
}

TEST(Triangle, entryIsWhereThePointIsInTheMovingTriangle) {
  std::mt19937 random(2);
  int found = 0;
  for (int k = 0; k < 5000; ++k) {
    const Corners a{randomPoint(random), randomPoint(random), randomPoint(random)};
    const Corners b{randomPoint(random), randomPoint(random), randomPoint(random)};
    const Vec3 p = randomPoint(random), q = randomPoint(random);
    const auto hit = firstEntry(p, q, a, b);
    if (!hit) continue;
    ++found;
    const double s = hit->time;
    const Corners now{a.a + s * (b.a - a.a), a.b + s * (b.b - a.b), a.c + s * (b.c - a.c)};
    EXPECT_NEAR((now.at(hit->weights) - (p + s * (q - p))).norm(), 0, 1e-7);
    // just before it is in front, just after behind
    const auto side = [&](double time) {
      const Corners c{a.a + time * (b.a - a.a), a.b + time * (b.b - a.b), a.c + time * (b.c - a.c)};
      return (p + time * (q - p) - c.a).dot(c.areaNormal());
    };
    EXPECT_GE(side(s - 1e-6), -1e-12);
    EXPECT_LE(side(s + 1e-6), 1e-12);
  }
  EXPECT_GT(found, 100);
  std::printf("%d entries in 5000 random motions\n", found);
}

TEST(Triangle, entryFromTheBackIsNone) {
  const Corners t{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  EXPECT_TRUE(firstEntry({0, 0, 1}, {0, 0, -1}, t, t));
  EXPECT_FALSE(firstEntry({0, 0, -1}, {0, 0, 1}, t, t));
  EXPECT_TRUE(firstEntry({0, 0, 0}, {0, 0, -1}, t, t)) << "from the surface itself";
  EXPECT_FALSE(firstEntry({0, 0, 1}, {0, 0, 0}, t, t)) << "only reaches it";
}

// Points between the front and the back of a bumpy sheet's edges and nodes go through, too.
TEST(Triangle, nothingSlipsBetweenNeighbours) {
  std::mt19937 random(3);
  Surface s = grid(4, 0.3);
  shake(s.x, random, 0.05);
  int through = 0, all = 0;
  for (const Triangle& t : s.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 &a = s.x[static_cast<std::size_t>(t[c])],
                 &b = s.x[static_cast<std::size_t>(t[(c + 1) % 3])];
      if (std::abs(a.x()) > 0.5 || std::abs(a.y()) > 0.5) continue;
      for (int k = 0; k <= 10; ++k) {
        const Vec3 p = a + 0.1 * k * (b - a);
        if (p.cwiseAbs().head<2>().maxCoeff() > 0.5) continue;
        ++all;
        const Vec3 up = Vec3::UnitZ() + 0.3 * randomPoint(random);
        bool hit = false;
        for (const Triangle& other : s.triangles) {
          const Corners corners = cornersOf(other, s.x);
          hit = hit || firstEntry(p + up, p - up, corners, corners);
        }
        through += hit ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(through, all);
  std::printf("%d paths through edges and nodes, all found\n", all);
}

TEST(SurfaceLinks, pseudonormalTellsInsideFromOutside) {
  const Surface s = readSurface(std::string(STROMA_MESHES) + "/cornea_shell.obj");
  SurfaceLinks links;
  links.build(s.triangles, static_cast<Index>(s.x.size()));
  EXPECT_TRUE(links.closed());
  // a step from the surface along the outward direction is outside, against it inside
  for (std::size_t t = 0; t < s.triangles.size(); t += 7) {
    for (const Vec3& w : {Vec3(1, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.3, 0.3, 0.4)}) {
      const Vec3 n = links.pseudonormal(static_cast<Index>(t), w, s.x).normalized();
      for (const double step : {1e-6, -1e-6}) {
        const Vec3 p = cornersOf(s.triangles[t], s.x).at(w) + step * n;
        double best = 1, side = 0;
        for (std::size_t o = 0; o < s.triangles.size(); ++o) {
          const TrianglePoint near = nearestOnTriangle(cornersOf(s.triangles[o], s.x), p);
          if (near.distance2 >= best) continue;
          best = near.distance2;
          side = (p - near.point).dot(links.pseudonormal(static_cast<Index>(o), near.weights, s.x));
        }
        EXPECT_GT(side * step, 0) << "triangle " << t;
      }
    }
  }
}

TEST(SurfaceLinks, changesGiveTheSameAsBuildingAnew) {
  Surface s = grid(5, 0.2);
  SurfaceLinks changed, built;
  changed.build(s.triangles, static_cast<Index>(s.x.size()));
  s.x.push_back(Vec3(0.01, 0.02, 0.3));
  const auto node = static_cast<Index>(s.x.size()) - 1;
  s.triangles[7][1] = node;
  s.triangles[20] = {0, 0, 0};
  s.triangles.push_back({3, 9, node});
  for (const Index t : {7, 20, static_cast<int>(s.triangles.size()) - 1}) {
    changed.change(t, s.triangles[static_cast<std::size_t>(t)]);
  }
  built.build(s.triangles, static_cast<Index>(s.x.size()));
  for (Index n = 0; n < built.nodeCount(); ++n) {
    std::vector<Index> a, b;
    changed.forCorners(n, [&](Index t, Index c) { a.push_back(3 * t + c); });
    built.forCorners(n, [&](Index t, Index c) { b.push_back(3 * t + c); });
    EXPECT_EQ(a, b) << "node " << n;
  }
}

TEST(ContactLaws, forcesAreGradientsOfTheirEnergies) {
  const PenaltyLaw penalty{70, 0.4};
  constexpr double h = 1e-6;
  for (const double d : {-0.1, 0.05, 0.39, 0.5}) {
    EXPECT_NEAR(penalty.force(d), (penalty.energy(d + h) - penalty.energy(d - h)) / (2 * h), 1e-6);
    EXPECT_NEAR(penalty.tangent(d), (penalty.force(d + h) - penalty.force(d - h)) / (2 * h), 1e-6);
  }
  const FrictionLaw friction{50, 2};
  const Mat3 across = Vec3(1, 1, 0).asDiagonal();
  for (const Vec3& e : {Vec3(0.01, -0.02, 0), Vec3(0.1, 0.2, 0)}) {
    EXPECT_LE(friction.force(e).norm(), 2 + 1e-15);
    for (int k = 0; k < 2; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const double slope = (friction.energy(e + step) - friction.energy(e - step)) / (2 * h);
      EXPECT_NEAR(friction.force(e)[k], slope, 1e-7);
      const Vec3 change = (friction.force(e + step) - friction.force(e - step)) / (2 * h);
      EXPECT_NEAR((friction.tangent(e, across).col(k) - change).norm(), 0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace stroma::test
