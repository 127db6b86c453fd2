// SPDX-License-Identifier: Apache-2.0
#include "tools/study/field_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace stroma::study {
namespace {

Vec3 quadratic(const Vec3& X) {
  const double x = X.x(), y = X.y(), z = X.z();
  return {1 + 2 * x - y + x * x - 3 * y * z, 0.5 - z + 2 * z * z + x * y, x - y * y + z * x};
}
Vec3 linear(const Vec3& X) { return {1 + X.x() - 2 * X.y(), X.z(), 3 - X.x() + X.z()}; }

std::vector<Vec3> cloud(int count, const Vec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double x = share(random), y = share(random), z = share(random);
    points.push_back(Vec3(x, y, z).cwiseProduct(size));
  }
  return points;
}

template <class Field>
double worst(const std::vector<Vec3>& nodes, const std::vector<Vec3>& points, Field field) {
  std::vector<Vec3> u;
  for (const Vec3& node : nodes) u.push_back(field(node));
  const std::vector<Vec3> fitted = fitField(nodes, u, points);
  EXPECT_EQ(fitted.size(), points.size());
  double error = 0;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    error = std::max(error, (fitted[i] - field(points[i])).norm());
  }
  return error;
}

TEST(FieldFit, reproducesQuadraticsOnAnIrregularCloud) {
  const double error = worst(cloud(2000, {1, 1, 1}, 1), cloud(50, {1, 1, 1}, 2), quadratic);
  std::printf("quadratic field off by %.1e\n", error);
  EXPECT_LT(error, 1e-10);
}

TEST(FieldFit, reproducesQuadraticsInMillimetres) {
  const auto scaled = [](const Vec3& X) { return Vec3(1e-3 * quadratic(1e3 * X)); };
  EXPECT_LT(worst(cloud(2000, {1e-3, 1e-3, 1e-3}, 3), cloud(50, {1e-3, 1e-3, 1e-3}, 4), scaled),
            1e-13);
}

TEST(FieldFit, reproducesLinearFieldsWhereNodesAreTwoLayersOneLayerOrALine) {
  std::vector<Vec3> two, one, line;
  for (int i = 0; i < 12; ++i) {
    line.emplace_back(0.1 * i, 0, 0);
    for (int j = 0; j < 12; ++j) {
      one.emplace_back(0.1 * i, 0.1 * j, 0);
      two.emplace_back(0.1 * i, 0.1 * j, 0);
      two.emplace_back(0.1 * i, 0.1 * j, 0.1);
    }
  }
  EXPECT_LT(worst(two, cloud(30, {1, 1, 0.1}, 5), linear), 1e-12);
  EXPECT_LT(worst(one, cloud(30, {1, 1, 0}, 6), linear), 1e-12);
  EXPECT_LT(worst(line, cloud(30, {1, 0, 0}, 7), linear), 1e-12);
}

TEST(FieldFit, keepsCurvatureAlongTwoLayers) {
  std::vector<Vec3> nodes;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      nodes.emplace_back(0.1 * i, 0.1 * j, 0);
      nodes.emplace_back(0.1 * i, 0.1 * j, 0.1);
    }
  }
  const auto bent = [](const Vec3& X) { return Vec3(-X.x() * X.z(), 0, 0.5 * X.x() * X.x()); };
  EXPECT_LT(worst(nodes, cloud(30, {1, 1, 0.1}, 8), bent), 1e-10);
}

TEST(FieldFit, givesTheOnlyNodeItsValueAndNoNodesNothing) {
  const std::vector<Vec3> node{Vec3(1, 2, 3)}, u{Vec3(4, 5, 6)}, point{Vec3(0, 0, 0)};
  EXPECT_EQ(fitField(node, u, point).front(), u.front());
  EXPECT_TRUE(fitField({}, {}, point).empty());
}

}  // namespace
}  // namespace stroma::study
