// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "components/cutting/blade_course.h"
#include "components/cutting/rest_placement.h"

namespace stroma {
namespace {

std::vector<Vec3> jitteredBlock(int n, double spacing) {
  std::vector<Vec3> points;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        points.push_back(spacing *
                         Vec3(i + jitter(random), j + jitter(random), k + jitter(random)));
  return points;
}

std::vector<Vec3> moved(const std::vector<Vec3>& rest, auto&& motion) {
  std::vector<Vec3> x;
  for (const Vec3& X : rest) x.push_back(motion(X));
  return x;
}

// Two triangles a side, outward.
std::vector<RestTriangle> box(const Vec3& low, const Vec3& high) {
  std::vector<RestTriangle> out;
  const auto corner = [&](int k) {
    return Vec3(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z());
  };
  for (const auto& q : {std::array{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    out.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    out.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
  return out;
}

}  // namespace

TEST(RestPlacement, affineMotionIsInvertedExactly) {
  const std::vector<Vec3> rest = jitteredBlock(8, 1e-3);
  Mat3 F;
  F << 1.3, 0.2, 0, -0.4, 0.9, 0.1, 0.2, 0, 1.1;
  const Vec3 shift(0.01, -0.02, 0.005);
  const std::vector<Vec3> x = moved(rest, [&](const Vec3& X) { return Vec3(F * X + shift); });
  const RestPlacement placement(rest, RestPlacement::reachOf(rest));
  double worst = 0;
  for (double s = 0.5; s < 7; s += 0.7) {
    const Vec3 X(1e-3 * s, 3.1e-3, 7e-3 - 1e-3 * s);
    const auto place = placement.find(F * X + shift, X + Vec3(1e-3, -1e-3, 5e-4), x);
    ASSERT_TRUE(place);
    worst = std::max(worst, (place->rest - X).norm());
    EXPECT_LE((place->inverse * F - Mat3::Identity()).norm(), 0.02);
  }
  std::printf("largest error %.2g m\n", worst);
  // the ridge that keeps thin clouds safe costs a little of the affine fit, the iteration none
  EXPECT_LE(worst, 1e-6);
}

TEST(RestPlacement, bentBodyIsFollowedToSecondOrder) {
  const auto bend = [](const Vec3& X) {
    const double k = 60;  // 1/m: 8 mm are bent by half a radian
    return Vec3((1 / k - X.z()) * std::sin(k * X.x()), X.y(),
                1 / k - (1 / k - X.z()) * std::cos(k * X.x()));
  };
  std::vector<double> errors;
  for (const int n : {8, 16}) {
    const std::vector<Vec3> rest = jitteredBlock(n, 8e-3 / n);
    const std::vector<Vec3> x = moved(rest, bend);
    const RestPlacement placement(rest, RestPlacement::reachOf(rest));
    double sum = 0;
    int count = 0;
    for (double s = 2e-3; s < 6e-3; s += 3.7e-4, ++count) {
      const Vec3 X(s, 4e-3, 8e-3 - s);
      const auto place = placement.find(bend(X), X, x);
      ASSERT_TRUE(place);
      sum += (place->rest - X).norm();
    }
    errors.push_back(sum / count);
  }
  std::printf("errors %.3g m, %.3g m at half the spacing\n", errors[0], errors[1]);
  EXPECT_GT(errors[0] / errors[1], 3);
}

TEST(RestPlacement, farPointsHaveNoPlace) {
  const std::vector<Vec3> rest = jitteredBlock(4, 1e-3);
  const RestPlacement placement(rest, RestPlacement::reachOf(rest));
  EXPECT_FALSE(placement.find({0.1, 0, 0}, {0.1, 0, 0}, rest));
}

TEST(BladeCourse, measuresWhatIsInsideAClosedBody) {
  const BladeCourse course(box(Vec3::Zero(), Vec3(1, 1, 1)), true);
  const std::vector<Vec3> dipped{{0.4, 0.3, 1.5}, {0.4, 0.3, 0.6}};
  const auto in = course.of(dipped);
  EXPECT_NEAR(in.inside, 0.4, 1e-12);
  EXPECT_NEAR(in.firstAt, 0.5, 1e-12);
  EXPECT_TRUE(in.endsInside);
  ASSERT_TRUE(in.first);
  EXPECT_NEAR(in.first->z(), 1, 1e-12);
  // right through, with both ends outside
  const auto through = course.of(std::vector<Vec3>{{0.4, 0.3, 2}, {0.4, 0.3, 0.5}, {0.4, 0.3, -1}});
  EXPECT_NEAR(through.inside, 1, 1e-12);
  EXPECT_NEAR(through.last->z(), 0, 1e-12);
  EXPECT_FALSE(course.of(std::vector<Vec3>{{0.4, 0.3, 2}, {0.4, 0.3, 1.01}}).engaged());
  // wholly inside it goes through nothing
  const auto within = course.of(std::vector<Vec3>{{0.4, 0.3, 0.5}, {0.6, 0.3, 0.5}});
  EXPECT_NEAR(within.inside, 0.2, 1e-12);
  EXPECT_FALSE(within.first);
  EXPECT_TRUE(course.contains({0.1, 0.9, 0.5}));
  EXPECT_FALSE(course.contains({0.1, 1.1, 0.5}));
}

// However long the edge: only what is round the body is searched.
TEST(BladeCourse, longEdgesCostNoMore) {
  const BladeCourse course(box(Vec3::Zero(), Vec3(1, 1, 1)), true);
  const auto in = course.of(std::vector<Vec3>{{3e6, 2e6, 1e6}, {0.4, 0.3, 0.6}});
  EXPECT_TRUE(in.engaged());
  EXPECT_TRUE(in.endsInside);
  EXPECT_LT(in.inside, 2);
}

TEST(BladeCourse, openSheetIsInsideBeyond) {
  const std::vector<RestTriangle> sheet{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)},
                                        {Vec3(-1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}};
  const BladeCourse course(sheet, false);
  EXPECT_NEAR(course.of(std::vector<Vec3>{{0.2, 0.3, 1}, {0.2, 0.3, -0.25}}).inside, 0.25, 1e-12);
  EXPECT_FALSE(course.of(std::vector<Vec3>{{0.2, 0.3, 1}, {0.2, 0.3, 0.25}}).engaged());
}

}  // namespace stroma
