// SPDX-License-Identifier: Apache-2.0
// How far the point-based solids are from exact solutions, on jittered clouds: medians over five
// seeds, printed as a table. Long: label "accuracy".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "tests/components/mechanics/point_cloud.h"
#include "tests/components/mechanics/shell_cloud.h"
#include "tests/components/mechanics/static_solver.h"

namespace stroma::test {
namespace {

constexpr double youngModulus = 1000;
constexpr unsigned seeds = 5;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

const char* nameOf(GradientKind kind) {
  return kind == GradientKind::plain           ? "plain"
         : kind == GradientKind::fewIterations ? "consistent, few iterations"
                                               : "consistent, exact";
}

BodyOptions optionsFor(GradientKind kind) {
  BodyOptions options;
  options.gradient = kind;
  options.youngModulus = youngModulus;
  return options;
}

// Work of a free bar of square section under the end tractions of a bending moment, over the exact.
double pureBendingCompliance(int layers, unsigned seed, GradientKind kind) {
  const Body body(boxCloud({4 * layers, layers, layers}, 0.4, seed), optionsFor(kind));
  MlsElasticity<HookeCauchy> elasticity(HookeCauchy(youngModulus, 0.3), *body.bonds);
  const double middle = layers / 2.0;
  const auto load = body.tractionForces(
      [middle](const Vec3& x, const Vec3& n) { return Vec3(n.x() * (x.y() - middle), 0, 0); });
  const auto& X = body.cloud.positions;
  const std::vector<Vec3> u = solveLinear(elasticity, X, load, Springs(X));
  const double exact = std::pow(layers, 4) / 12 * 4 * layers / youngModulus;
  return flat(ConstVec3Span(u)).dot(flat(ConstVec3Span(load))) / exact;
}

double medianBending(int layers, GradientKind kind) {
  std::vector<double> values;
  for (unsigned seed = 1; seed <= seeds; ++seed)
    values.push_back(pureBendingCompliance(layers, seed, kind));
  const double value = median(values);
  std::printf("pure bending, %d layers, %s: compliance %.4f of the exact\n", layers, nameOf(kind),
              value);
  return value;
}

TEST(Accuracy, pureBendingOfJitteredClouds) {
  EXPECT_GT(medianBending(6, GradientKind::plain), 1.15);
  EXPECT_NEAR(medianBending(6, GradientKind::exact), 1, 0.11);
  EXPECT_NEAR(medianBending(6, GradientKind::fewIterations), 1, 0.11);
  EXPECT_NEAR(medianBending(8, GradientKind::fewIterations), 1, 0.06);
}

TEST(Accuracy, pureBendingConvergesWithSecondOrderWherePlainMlsStalls) {
  const double coarse = medianBending(4, GradientKind::exact) - 1;
  const double fine = medianBending(8, GradientKind::exact) - 1;
  const double order = std::log2(coarse / fine);
  const double plain = std::log2((medianBending(4, GradientKind::plain) - 1) /
                                 (medianBending(8, GradientKind::plain) - 1));
  std::printf("order of convergence from 4 to 8 layers: %.2f, plain MLS %.2f\n", order, plain);
  EXPECT_NEAR(fine, 0, 0.06);
  EXPECT_GE(order, 1.8);
  EXPECT_LT(plain, 1);
}

// Displacement of the middle of the face x = end, by the body's own surface shape.
Vec3 tipDisplacement(const Body& body, ConstVec3Span u, double end) {
  std::vector<Vec3> us(body.samples.size());
  body.shape.apply(u, us);
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (std::size_t s = 0; s < us.size(); ++s)
    if (body.samples[s].area.x() > 0 && std::abs(body.samples[s].position.x() - end) < 1e-9) {
      sum += us[s] * body.samples[s].area.x();
      area += body.samples[s].area.x();
    }
  return sum / area;
}

// The first layer held, as rigid tissue in a clamp.
Springs clamp(const Body& body, double below) {
  Springs springs(body.cloud.positions);
  for (std::size_t i = 0; i < body.cloud.positions.size(); ++i)
    if (body.cloud.positions[i].x() < below)
      springs.stiffness.segment<3>(3 * static_cast<Eigen::Index>(i)).setConstant(1e7);
  return springs;
}

TEST(Accuracy, cantileverUnderItsWeight) {
  const int layers = 7;
  const double nu = 0.3, length = 5 * layers, h = layers;
  const double G = youngModulus / (2 * (1 + nu)), shape = 10 * (1 + nu) / (12 + 11 * nu);
  const double w = 1e-3 * h * h, I = std::pow(h, 4) / 12;
  const double exact = w * std::pow(length, 4) / (8 * youngModulus * I) +
                       w * length * length / (2 * shape * G * h * h);
  for (const auto kind : {GradientKind::plain, GradientKind::fewIterations, GradientKind::exact}) {
    std::vector<double> values;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Body body(boxCloud({5 * layers, layers, layers}, 0.4, seed), optionsFor(kind));
      MlsElasticity<HookeCauchy> elasticity(HookeCauchy(youngModulus, nu), *body.bonds);
      std::vector<Vec3> load;
      for (const double v : body.cloud.volumes) load.emplace_back(0, -1e-3 * v, 0);
      const auto u = solveLinear(elasticity, body.cloud.positions, load, clamp(body, 1));
      values.push_back(-tipDisplacement(body, u, length).y() / exact);
    }
    std::printf("cantilever, %d layers, %s: tip %.4f of Timoshenko's\n", layers, nameOf(kind),
                median(values));
    if (kind == GradientKind::plain) {
      EXPECT_GT(median(values), 1.1);
    } else {
      EXPECT_NEAR(median(values), 1, 0.03);
    }
  }
}

// Slender bar of square section (a flat one buckles sideways), its first layer held, nu = 0, to the
// numbers k = P L^2 / EI (tip force) or w L^3 / EI (weight). Returns the tip's fall over L.
struct Elastica {
  static constexpr int layers = 8, width = 8, slenderness = 10;

  static std::vector<double> fall(unsigned seed, bool weight, const std::vector<double>& numbers) {
    const int n = layers * slenderness;
    Cloud cloud = boxCloud({n, layers, width}, 0.4, seed);
    const Body body(std::move(cloud), optionsFor(GradientKind::fewIterations));
    MlsElasticity<HookeCorotated> elasticity(HookeCorotated(youngModulus, 0), *body.bonds);
    const double L = layers * slenderness, area = layers * width;
    const double EI = youngModulus * width * std::pow(layers, 3) / 12;
    const auto& X = body.cloud.positions;
    std::vector<Vec3> unit(X.size(), Vec3::Zero());
    if (weight) {
      for (std::size_t i = 0; i < X.size(); ++i)
        unit[i] = Vec3(0, -body.cloud.volumes[i] / area * EI / std::pow(L, 3), 0);
    } else {
      unit = body.tractionForces([&](const Vec3& x, const Vec3& normal) {
        return x.x() > n - 0.01 && normal.x() > 0.5 ? Vec3(0, -EI / (L * L * area), 0)
                                                    : Vec3(0, 0, 0);
      });
    }
    const Springs springs = clamp(body, 1);
    std::vector<Vec3> x(X);
    std::vector<double> out;
    for (const double k : numbers) {
      const StaticProblem problem{[&](ConstVec3Span at, Vec3Span f) {
                                    flat(f) += k * flat(ConstVec3Span(unit));
                                    return k * flat(ConstVec3Span(unit)).dot(flat(at));
                                  },
                                  &springs, 1e-6};
      const StaticResult result = solveStatic(elasticity, x, problem);
      EXPECT_TRUE(result.converged) << "residual " << result.residual;
      std::vector<Vec3> u(x);
      flat(Vec3Span(u)) -= flat(ConstVec3Span(X));
      out.push_back(-tipDisplacement(body, u, n).y() / L);
    }
    return out;
  }

  static void check(bool weight, const std::vector<double>& numbers,
                    const std::vector<double>& expected) {
    std::vector<std::vector<double>> values(numbers.size());
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const std::vector<double> fallen = fall(seed, weight, numbers);
      for (std::size_t k = 0; k < numbers.size(); ++k) values[k].push_back(fallen[k]);
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double value = median(values[k]);
      std::printf("elastica, %s, number %.2f: fall/L %.5f, exact %.5f, ratio %.4f\n",
                  weight ? "heavy" : "tip force", numbers[k], value, expected[k],
                  value / expected[k]);
      EXPECT_NEAR(value / expected[k], 1, 0.03);
    }
  }
};

TEST(Accuracy, elasticaUnderATipForce) { Elastica::check(false, {1, 2}, {0.30172, 0.49346}); }

TEST(Accuracy, elasticaUnderItsWeight) { Elastica::check(true, {2, 8}, {0.23851, 0.64063}); }

// Radial displacement of a thick sphere under inner pressure, a = 1, b = 2, p = 1.
TEST(Accuracy, thickSphereUnderPressure) {
  for (const auto& [nu, inner, outer] :
       {std::tuple{0.3, 0.8e-3, 0.3e-3}, {0.4999, 0.85711e-3, 0.21433e-3}}) {
    std::vector<double> atInner, atOuter;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Body body(thickSphere(1, 2, 8, seed), optionsFor(GradientKind::fewIterations));
      MlsElasticity<HookeCauchy> elasticity(HookeCauchy(youngModulus, nu), *body.bonds);
      const auto load = body.tractionForces(
          [](const Vec3& x, const Vec3& n) { return x.norm() < 1.5 ? Vec3(-n) : Vec3(0, 0, 0); });
      const auto u = solveLinearIterative(elasticity, body.cloud.positions, load);
      std::vector<Vec3> us(body.samples.size());
      body.shape.apply(u, us);
      double sumIn = 0, sumOut = 0, areaIn = 0, areaOut = 0;
      for (std::size_t s = 0; s < us.size(); ++s) {
        const Vec3& x = body.samples[s].position;
        const double area = body.samples[s].area.norm(), radial = us[s].dot(x.normalized());
        (x.norm() < 1.5 ? sumIn : sumOut) += area * radial;
        (x.norm() < 1.5 ? areaIn : areaOut) += area;
      }
      atInner.push_back(sumIn / areaIn / inner);
      atOuter.push_back(sumOut / areaOut / outer);
    }
    std::printf("thick sphere, nu %.4f: u(a) %.4f, u(b) %.4f of Lame's\n", nu, median(atInner),
                median(atOuter));
    EXPECT_NEAR(median(atInner), 1, 0.03);
    EXPECT_NEAR(median(atOuter), 1, 0.03);
  }
}

// Clamped corneal cap against a converged axisymmetric finite-element solution, linear, nu = 0.45:
// apex rise under 2 kPa 173.7 um, apex depth under 10 mN on a patch of 0.789 mm radius 139.7 um.
TEST(Accuracy, clampedCornealCap) {
  for (const auto& [columns, layers, bound] : {std::tuple{500, 3, 0.15}, {600, 4, 0.05}}) {
    for (const auto kind : {GradientKind::plain, GradientKind::fewIterations}) {
      BodyOptions options = optionsFor(kind);
      options.youngModulus = 5e5;
      options.neighbours = 0;
      options.radius = 1.6;
      const Body body(corneaCap(columns, layers), options);
      MlsElasticity<HookeCauchy> elasticity(HookeCauchy(5e5, 0.45), *body.bonds);
      const auto [rise, depth] = capResponse(body, elasticity);
      std::printf("corneal cap, %zu particles in %d layers, %s: inflation %.3f, indentation %.3f\n",
                  body.cloud.positions.size(), layers, nameOf(kind), rise / 173.7e-6,
                  depth / 139.7e-6);
      if (kind == GradientKind::plain) continue;
      EXPECT_NEAR(rise / 173.7e-6, 1, bound);
      EXPECT_NEAR(depth / 139.7e-6, 1, bound);
    }
  }
}

}  // namespace
}  // namespace stroma::test
