// SPDX-License-Identifier: Apache-2.0
// Laws of the constraints and of their projection.
#include <Eigen/LU>
#include <cmath>

#include "components/xpbd/edge_distances.h"
#include "tests/components/xpbd/pair_body.h"

namespace stroma::test {
namespace {

const std::vector<Vec3> corner{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Mat3 edgesOf(const std::vector<Vec3>& x) {
  Mat3 edges;
  for (int a = 1; a < 4; ++a) edges.col(a - 1) = x[static_cast<std::size_t>(a)] - x[0];
  return edges;
}

TEST(TetrahedronPair, gradientsAreThoseOfFiniteDifferences) {
  double worst = 0;
  bool inverted = false;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::vector<Vec3> rest = randomField(4, 0.2, seed), x = randomField(4, 1, seed + 100);
    for (std::size_t a = 0; a < 4; ++a) rest[a] += corner[a];
    const Mat3 inverse = edgesOf(rest).inverse();
    const auto pair = makePair(edgesOf(x), inverse);
    inverted |= pair.volume < 0;
    constexpr double h = 1e-5;
    for (int a = 0; a < 4; ++a) {
      for (int c = 0; c < 3; ++c) {
        std::vector<Vec3> more = x, less = x;
        more[static_cast<std::size_t>(a)][c] += h;
        less[static_cast<std::size_t>(a)][c] -= h;
        const auto up = makePair(edgesOf(more), inverse), down = makePair(edgesOf(less), inverse);
        const double slopeD = (up.deviatoric - down.deviatoric) / (2 * h);
        const double slopeH = (up.volume - down.volume) / (2 * h);
        worst = std::max({worst, std::abs(slopeD - pair.dDeviatoric[a][c]),
                          std::abs(slopeH - pair.dVolume[a][c])});
      }
    }
  }
  std::printf("gradients against differences: %.1e\n", worst);
  EXPECT_TRUE(inverted);
  EXPECT_LT(worst, 1e-8);
}

TEST(TetrahedronPair, projectionKeepsMomentum) {
  PairBody body(1);
  double linear = 0, angular = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    TetrahedronPairs pair(body.rest, std::span(body.elements).first(1));
    pair.setModuli({3, 8});
    const std::vector<Vec3> before = randomField(body.rest.size(), 1, seed);
    body.x = before;
    ASSERT_EQ(pair.project(body.particles(2), 0.1), 0u);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < body.x.size(); ++i) {
      const Vec3 impulse = (body.x[i] - before[i]) / body.inverseMass[i];
      force += impulse;
      torque += before[i].cross(impulse);
      sum += impulse.norm();
    }
    linear = std::max(linear, force.norm() / sum);
    angular = std::max(angular, torque.norm() / sum);
  }
  std::printf("momentum of a projection: %.1e, about the origin %.1e of the sum\n", linear,
              angular);
  EXPECT_LT(linear, 1e-14);
  EXPECT_LT(angular, 1e-14);
}

// Both constraints are far from zero at rest: solved one after the other they would move it.
TEST(TetrahedronPairs, aBodyAtRestStaysThere) {
  for (const double stiff : {1e-4, 1e-2, 1.0}) {
    PairBody body(3);
    body.pairs.setModuli({stiff, 2.5 * stiff});
    for (int k = 0; k < 10; ++k) EXPECT_EQ(body.project(1), 0u);
    const double moved = body.largestMove(body.rest);
    std::printf("h^2 stiffness / mass about %.0e: moved by %.1e of a cell\n", stiff, moved);
    EXPECT_LT(moved, 2e-15);
  }
}

TEST(TetrahedronPairs, sweepsSettle) {
  PairBody body(2);
  body.pairs.setModuli({3, 8});
  const std::vector<Vec3> noise = randomField(body.rest.size(), 0.2, 4);
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += noise[i];
  double first = 0, moved = 0;
  for (int sweep = 1; sweep <= 64; ++sweep) {
    const std::vector<Vec3> before = body.x;
    EXPECT_EQ(body.project(0.2), 0u);
    moved = body.largestMove(before);
    if (sweep == 1) first = moved;
    if ((sweep & (sweep - 1)) == 0) std::printf("sweep %2d moves by %.1e\n", sweep, moved);
  }
  EXPECT_LT(moved, 1e-14 * first);
}

// The multipliers of one step act along gradients that turn from sweep to sweep: what settles
// differs from implicit Euler's step by a part that falls with the square of its length.
TEST(TetrahedronPairs, sweepsComeCloseToTheImplicitStepAtSecondOrder) {
  const TetrahedronModuli moduli{3, 8};
  double last = 0;
  for (const double h : {0.16, 0.08, 0.04, 0.02}) {
    PairBody body(2);
    body.pairs.setModuli(moduli);
    const std::vector<Vec3> noise = randomField(body.rest.size(), 0.2, 4);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += noise[i];
    const std::vector<Vec3> predicted = body.x;
    for (int sweep = 0; sweep < 50; ++sweep) (void)body.project(h);
    // x - x* + h^2 M^-1 grad U(x) over its second part
    std::vector<Vec3> pull(body.x.size(), Vec3::Zero()), rest(body.x.size());
    for (const Tetrahedron& t : body.elements) {
      const auto pair = body.pairOf(t, body.x);
      const double pressure = moduli.l * (pair.volume - 1 - moduli.mu / moduli.l);
      for (int a = 0; a < 4; ++a) {
        const auto i = static_cast<std::size_t>(t[a]);
        pull[i] += h * h * body.volumeOf(t) * body.inverseMass[i] *
                   (moduli.mu * pair.deviatoric * vec(pair.dDeviatoric[a]) +
                    pressure * vec(pair.dVolume[a]));
      }
    }
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = body.x[i] - predicted[i] + pull[i];
    const double error = flat(ConstVec3Span(rest)).norm() / flat(ConstVec3Span(pull)).norm();
    std::printf("h %.2f: %.1e of the implicit step's pull is missing\n", h, error);
    if (last > 0) {
      EXPECT_LT(error, last / 3);
    }
    last = error;
  }
  EXPECT_LT(last, 5e-3);
}

TEST(TetrahedronPairs, invertedBodiesRecover) {
  for (const char* kind : {"mirrored", "flat", "scrambled"}) {
    PairBody body(3);
    body.pairs.setModuli({3, 8});
    const std::vector<Vec3> noise = randomField(body.rest.size(), 1.5, 9);
    for (std::size_t i = 0; i < body.x.size(); ++i) {
      Vec3& x = body.x[i];
      if (kind[0] == 'm') x[2] = -x[2];
      if (kind[0] == 'f') x[2] = 0;
      // what is exactly flat or mirrored is in unstable equilibrium against turning back
      x += (kind[0] == 's' ? 1 : 1e-3) * noise[i];
    }
    const double before = body.smallestRatio();
    int steps = 0;
    std::uint64_t skipped = 0;
    while (body.smallestRatio() < 0.99 && steps < 3000) {
      body.start = body.x;
      body.pairs.clearMultipliers();
      skipped += body.project(0.3);
      ++steps;
    }
    std::printf("%s: volume ratio from %.3f to %.3f in %d steps\n", kind, before,
                body.smallestRatio(), steps);
    EXPECT_GE(body.smallestRatio(), 0.99) << kind;
    EXPECT_EQ(skipped, 0u);
  }
}

TEST(TetrahedronPairs, collapsedAndNonFiniteElementsAreSkippedAndCounted) {
  PairBody body(1);
  body.pairs.setModuli({3, 8});
  std::ranges::fill(body.x, Vec3(1, 2, 3));
  EXPECT_EQ(body.project(1), body.elements.size());
  EXPECT_EQ(body.x.front(), Vec3(1, 2, 3));
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] = body.rest[i][0] * Vec3::UnitX();
  EXPECT_EQ(body.project(1), 0u);  // |F| has a gradient where a volume has none
  body.pairs.setModuli({0, 8});
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] = body.rest[i][0] * Vec3::UnitX();
  EXPECT_EQ(body.project(1), body.elements.size());
  body.pairs.setModuli({3, 8});
  body.x = body.rest;
  body.x[0][0] = std::nan("");
  EXPECT_GT(body.project(1), 0u);
  EXPECT_TRUE(body.x[1].allFinite());
}

TEST(TetrahedronPairs, withoutShearStiffnessOnlyTheVolumeIsKept) {
  PairBody body(2);
  body.pairs.setModuli({0, 1e6});
  const Mat3 shear = (Mat3() << 1, 0.7, 0, 0, 2, 0, 0, 0, 0.5).finished();
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] = shear * body.rest[i];
  const std::vector<Vec3> sheared = body.x;
  EXPECT_EQ(body.project(1), 0u);
  EXPECT_LT(body.largestMove(sheared), 1e-14);
  for (Vec3& x : body.x) x *= 1.1;
  for (int k = 0; k < 200; ++k) (void)body.project(1);
  for (const Tetrahedron& t : body.elements) EXPECT_NEAR(body.pairOf(t, body.x).volume, 1, 2e-3);
}

TEST(TetrahedronPairs, particlesHeldInPartStayOnTheirPlaneAndHeldOnesWhereTheyAre) {
  PairBody body(2);
  body.pairs.setModuli({3, 8});
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  std::vector<const Mat3*> partly(body.x.size(), nullptr);
  partly[4] = &plane;
  body.inverseMass[8] = 0;
  const std::vector<Vec3> noise = randomField(body.rest.size(), 0.2, 4);
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += noise[i];
  const std::vector<Vec3> before = body.x;
  for (int k = 0; k < 10; ++k)
    (void)body.pairs.project({body.x, body.start, body.inverseMass, partly, 1}, 0.1);
  EXPECT_LT(std::abs(normal.dot(body.x[4] - before[4])), 1e-15);
  EXPECT_GT((body.x[4] - before[4]).norm(), 0.01);
  EXPECT_EQ(body.x[8], before[8]);
}

TEST(EdgeDistances, oneEdgeIsSolvedExactly) {
  const std::vector<Vec3> rest{{0, 0, 0}, {2, 0, 0}};
  EdgeDistances edges(rest, std::vector<Edge>{{0, 1}});
  edges.setStiffness(50);
  std::vector<Vec3> x{{0, 0, 0}, {0, 3, 0}};
  const std::vector<double> w{0.5, 1};
  const double h = 0.2, k = h * h * 25, stretch = 1 / (1 + k * 1.5);
  for (int sweep = 0; sweep < 3; ++sweep) {
    EXPECT_EQ(edges.project({x, rest, w, {}, h}, 0), 0u);
    EXPECT_NEAR((x[1] - x[0]).norm(), 2 + stretch, 1e-14) << "sweep " << sweep;
  }
  EXPECT_NEAR(x[0][1], k * stretch * 0.5, 1e-14);
  x[1] = x[0];
  EXPECT_EQ(edges.project({x, rest, w, {}, h}, 0), 1u);
}

}  // namespace
}  // namespace stroma::test
