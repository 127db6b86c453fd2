// SPDX-License-Identifier: Apache-2.0
#include "components/stability/body_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "components/stability/energy_balance.h"

namespace stroma {
namespace {

std::vector<Vec3> corners() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  return points;
}

TEST(BodyMeasures, rigidMotionIsNoShapeError) {
  const auto rest = corners();
  const Mat3 turn = Eigen::AngleAxisd(2.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vec3> x = rest;
  for (Vec3& p : x) p = turn * p + Vec3(5, -3, 2);
  EXPECT_LT(largestShapeError(x, rest), 1e-14);
  EXPECT_GT(largestDisplacement(x, rest), 3);
  EXPECT_EQ(longestSide(rest), 1);
}

TEST(BodyMeasures, aMirrorImageIsAShapeError) {
  const auto rest = corners();
  std::vector<Vec3> x = rest;
  for (Vec3& p : x) p.z() = -p.z();
  EXPECT_GT(largestShapeError(x, rest), 0.4);
}

TEST(BodyMeasures, momentaOfARigidSpin) {
  const auto x = corners();
  const Vec3 spin(0, 0, 2), middle(0.5, 0.5, 0.5);
  std::vector<Vec3> v;
  for (const Vec3& p : x) v.push_back(Vec3(1, 0, 0) + spin.cross(p - middle));
  const std::vector<double> mass(8, 0.25);
  Momenta m;
  addMomenta(x, v, mass, middle, m);
  EXPECT_LT((m.linear - Vec3(2, 0, 0)).norm(), 1e-15);
  EXPECT_LT((m.angular - Vec3(0, 0, 8 * 0.25 * 0.5 * 2)).norm(), 1e-15);
  EXPECT_GE(m.linearScale, m.linear.norm());
}

TEST(BodyMeasures, invertedElementsAreCounted) {
  const std::vector<Vec3> rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<Tetrahedron> elements{{0, 1, 2, 3}, {1, 2, 3, 4}};
  std::vector<Vec3> x = rest;
  EXPECT_EQ(countInverted(elements, x, rest), 0u);
  x[0] = {1, 1, 1};
  EXPECT_EQ(countInverted(elements, x, rest), 1u);
  for (Vec3& p : x) p = rest[static_cast<std::size_t>(&p - x.data())].cwiseProduct(Vec3(1, 1, 0));
  EXPECT_EQ(countInverted(elements, x, rest), 2u) << "flat ones";
  const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<Vec3> dented = cube;
  const std::vector<Hexahedron> one{{0, 1, 2, 3, 4, 5, 6, 7}};
  EXPECT_EQ(countInverted(one, dented, cube), 0u);
  dented[6] = {0.2, 0.2, 0.2};
  EXPECT_EQ(countInverted(one, dented, cube), 1u);
}

TEST(EnergyBalance, workOfLoadsIsNoGrowth) {
  EnergyBalance balance;
  balance.begin({1, 2});
  balance.loadsMoved({1, 5});  // a spring is drawn by 3 J
  balance.moved({2.5, 3});     // half a joule goes
  EXPECT_DOUBLE_EQ(balance.work(), 3);
  EXPECT_DOUBLE_EQ(balance.growth(), -0.5);
  EXPECT_DOUBLE_EQ(balance.rise(), -0.5);
  balance.loadsMoved({2.5, 3});
  balance.moved({2.5, 3.25});  // a quarter comes from nowhere
  EXPECT_DOUBLE_EQ(balance.growth(), -0.25);
  EXPECT_DOUBLE_EQ(balance.rise(), 0.25);
  EXPECT_DOUBLE_EQ(balance.scale(), 2.5);
}

}  // namespace
}  // namespace stroma
