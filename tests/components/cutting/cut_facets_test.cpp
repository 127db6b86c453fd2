// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "components/cutting/cut_facets.h"
#include "components/cutting/exact_predicates.h"
#include "gtest/gtest.h"

namespace stroma::test {
namespace {

// A plate of squares in the plane z = 0.
std::vector<RestTriangle> plate(int n) {
  std::vector<RestTriangle> facets;
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      const Vec3 a(i, j, 0), b(i + 1, j, 0), c(i + 1, j + 1, 0), d(i, j + 1, 0);
      facets.push_back({a, b, c});
      facets.push_back({a, c, d});
    }
  return facets;
}

Index hits(const std::vector<RestTriangle>& facets, const Vec3& p, const Vec3& q) {
  Index count = 0;
  for (const RestTriangle& t : facets) count += segmentCrossesTriangle(p, q, t[0], t[1], t[2]);
  return count;
}

TEST(CutFacets, noSegmentSlipsThroughAnEdgeOrACorner) {
  const auto facets = plate(3);
  // end points on the plate's vertices, edges and diagonals; each side counts the same facet
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0.5, 0.5, 0),
                        Vec3(0.25, 0.25, 0), Vec3(0.3, 0.1, 0)})
    for (const Vec3& d : {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(-0.5, 0.25, 0.5)}) {
      EXPECT_EQ(hits(facets, x - d, x + d), 1);
      EXPECT_EQ(hits(facets, x + d, x - d), 1);
      EXPECT_EQ(hits(facets, x, x + d) + hits(facets, x, x - d), 1);
    }
  EXPECT_EQ(hits(facets, {-0.5, 0, 0}, {0.5, 0, 0}), 0);  // in the plate: on one side of it
}

TEST(CutFacets, aClosedSurfaceIsCrossedEvenlyBetweenOutsidePoints) {
  // octahedron; random lattice segments make ties of all kinds
  std::vector<RestTriangle> facets;
  for (int sx : {-1, 1})
    for (int sy : {-1, 1})
      for (int sz : {-1, 1})
        facets.push_back({Vec3(2 * sx, 0, 0), Vec3(0, 2 * sy, 0), Vec3(0, 0, 2 * sz)});
  std::mt19937 random(3);
  std::uniform_int_distribution<int> lattice(-4, 4);
  for (int k = 0; k < 20000; ++k) {
    const auto outside = [&] {
      for (;;) {
        const Vec3 x(lattice(random), lattice(random), lattice(random));
        if (x.cwiseAbs().sum() > 2) return x;
      }
    };
    const Vec3 p = outside(), q = outside();
    EXPECT_EQ(hits(facets, p, q) % 2, 0) << p.transpose() << " to " << q.transpose();
  }
}

TEST(CutFacets, gridAgreesWithBruteForceAndIsSymmetric) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vec3(any(random), any(random), any(random)); };
  CutFacets facets(0.3);
  for (int k = 0; k < 200; ++k) {
    const Vec3 x = point();
    const RestTriangle t = {x, x + 0.3 * point(), x + 0.3 * point()};
    facets.add({&t, 1});
  }
  Index crossed = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 p = point(), q = p + 0.4 * point();
    const bool yes = facets.crosses(p, q);
    crossed += yes ? 1 : 0;
    EXPECT_EQ(yes, facets.crossesBruteForce(p, q));
    EXPECT_EQ(yes, facets.crosses(q, p));
    if (facets.crossesNew(p, q, 100)) {
      EXPECT_TRUE(yes);
    }
    EXPECT_FALSE(facets.crossesNew(p, q, facets.count()));
  }
  EXPECT_GT(crossed, 100);
}

TEST(ExactPredicates, seeWhatRoundingHides) {
  const Vec3 a(0.1, 0.2, 0.3), b = a + Vec3(1, 0, 0), c = a + Vec3(0, 1, 0);
  const double up = std::nextafter(0.3, 1.0);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.7, 0.4, up)), 1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.7, 0.4, 0.3)), 0);
  EXPECT_EQ(sideOf(a, b, c, Vec3(0.7, 0.4, 0.3)), 1);
  EXPECT_EQ(sideOf(a, c, b, Vec3(0.7, 0.4, 0.3)), -1);
}

}  // namespace
}  // namespace stroma::test
