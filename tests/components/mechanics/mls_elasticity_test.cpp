// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_elasticity.h"

#include <gtest/gtest.h>

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/stable_neo_hookean.h"
#include "components/material/volume_penalty.h"
#include "components/mechanics/stability.h"
#include "components/sampling/surface_mesh.h"
#include "tests/components/mechanics/point_cloud.h"
#include "tests/components/mechanics/static_solver.h"

namespace stroma::test {
namespace {

constexpr double youngModulus = 1000, poissonRatio = 0.3;

template <class Material>
Material makeMaterial() {
  return Material(youngModulus, poissonRatio);
}
template <>
VolumePenalty makeMaterial<VolumePenalty>() {
  return VolumePenalty(youngModulus);
}

Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

std::vector<Vec3> randomField(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> field(count);
  for (Vec3& v : field) v = Vec3(uniform(random), uniform(random), uniform(random));
  return field;
}

std::vector<Vec3> moved(ConstVec3Span X, const Mat3& A, const Vec3& t) {
  std::vector<Vec3> x(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) x[i] = A * X[i] + t;
  return x;
}

double dot(ConstVec3Span a, ConstVec3Span b) { return flat(a).dot(flat(b)); }
double norm(ConstVec3Span a) { return flat(a).norm(); }

Body smallBody(GradientKind gradient = GradientKind::exact) {
  BodyOptions options;
  options.gradient = gradient;
  return Body(boxCloud({5, 4, 4}, 0.4, 7), options);
}

// A jittered box with a flat patch, a line and a hermit far away from it and from each other.
Body degenerateBody() {
  Cloud cloud = boxCloud({4, 4, 4}, 0.3, 3);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int i = 0; i < 16; ++i)
    cloud.positions.push_back(rotation(0.7, Vec3(1, 1, 0)) *
                                  Vec3(i % 4 + uniform(random), i / 4 + uniform(random), 0) +
                              Vec3(40, 0, 0));
  for (int i = 0; i < 5; ++i)
    cloud.positions.push_back(Vec3(0, 40, 0) + (i + uniform(random)) * Vec3(1, 2, 2) / 3);
  cloud.positions.push_back(Vec3(0, 0, 40));
  cloud.volumes.resize(cloud.positions.size(), 1.0);
  BodyOptions options;
  options.neighbours = 0;
  options.radius = 2.2;
  options.gradient = GradientKind::plain;
  return Body(std::move(cloud), options);
}

template <class Material>
class PointForce : public ::testing::Test {};
using Laws =
    ::testing::Types<HookeCauchy, HookeGreen, HookeCorotated, StableNeoHookean, VolumePenalty>;
TYPED_TEST_SUITE(PointForce, Laws);

template <class Material>
double forceError(const Body& body, ConstVec3Span x) {
  MlsElasticity<Material> elasticity(makeMaterial<Material>(), *body.bonds);
  std::vector<Vec3> f(x.size(), Vec3::Zero());
  elasticity.addForces(x, f);
  double worst = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const std::vector<Vec3> d = randomField(x.size(), 1, 50 + seed);
    const auto at = [&](double h) {
      std::vector<Vec3> y(x.begin(), x.end());
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * d[i];
      return elasticity.energy(y);
    };
    const double h = 1e-4;
    const double slope = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    worst = std::max(worst, std::abs(slope + dot(f, d)) / (norm(f) * norm(d)));
  }
  return worst;
}

TYPED_TEST(PointForce, isMinusEnergyGradient) {
  const Body body = smallBody();
  std::vector<Vec3> x = moved(body.cloud.positions, rotation(1, Vec3(1, 2, 3)), Vec3(3, 2, 1));
  const std::vector<Vec3> noise = randomField(x.size(), 0.05, 8);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += noise[i];
  const double error = forceError<TypeParam>(body, x);
  std::printf("force against energy differences: %.2e\n", error);
  EXPECT_LT(error, 1e-8);
}

TYPED_TEST(PointForce, isMinusEnergyGradientOfDegenerateNeighbourhoods) {
  if (std::is_same_v<TypeParam, HookeCauchy>) GTEST_SKIP() << "completion needs an objective law";
  const Body body = degenerateBody();
  std::vector<Vec3> x(body.cloud.positions);
  const std::vector<Vec3> noise = randomField(x.size(), 0.05, 9);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += noise[i];
  const double error = forceError<TypeParam>(body, x);
  std::printf("force against energy differences: %.2e\n", error);
  EXPECT_LT(error, 1e-8);
}

TYPED_TEST(PointForce, stiffnessProductIsForceDerivative) {
  for (const bool degenerate : {false, true}) {
    if (degenerate && std::is_same_v<TypeParam, HookeCauchy>) continue;
    const Body body = degenerate ? degenerateBody() : smallBody();
    std::vector<Vec3> x(body.cloud.positions);
    const std::vector<Vec3> noise = randomField(x.size(), 0.05, 10),
                            d = randomField(x.size(), 1, 11);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += noise[i];
    MlsElasticity<TypeParam> elasticity(makeMaterial<TypeParam>(), *body.bonds);
    elasticity.prepareTangent(x);
    std::vector<Vec3> product(x.size(), Vec3::Zero()), difference(x.size(), Vec3::Zero());
    elasticity.addStiffnessProduct(1, d, product);
    const double h = 1e-5;
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> y(x), f(x.size(), Vec3::Zero());
      for (std::size_t i = 0; i < x.size(); ++i) y[i] += side * h * d[i];
      elasticity.addForces(y, f);
      for (std::size_t i = 0; i < x.size(); ++i) difference[i] -= side * f[i] / (2 * h);
    }
    flat(Vec3Span(difference)) -= flat(Vec3Span(product));
    const double error = norm(difference) / norm(product);
    std::printf("stiffness product against force differences: %.2e\n", error);
    EXPECT_LT(error, 1e-7);
  }
}

TYPED_TEST(PointForce, assembledStiffnessIsTheProduct) {
  for (const bool degenerate : {false, true}) {
    const Body body = degenerate ? degenerateBody() : smallBody();
    std::vector<Vec3> x(body.cloud.positions);
    const std::vector<Vec3> noise = randomField(x.size(), 0.05, 10),
                            d = randomField(x.size(), 1, 11);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += noise[i];
    MlsElasticity<TypeParam> elasticity(makeMaterial<TypeParam>(), *body.bonds);
    for (const auto definiteness : {TangentKind::exact, TangentKind::filtered}) {
      elasticity.prepareTangent(x, definiteness);
      std::vector<Vec3> product(x.size(), Vec3::Zero());
      elasticity.addStiffnessProduct(1, d, product);
      std::vector<Vec3> assembled(x.size(), Vec3::Zero());
      elasticity.assembleStiffness(
          [&](Index a, Index b, const Mat3& block) { assembled[a] += block * d[b]; });
      flat(Vec3Span(assembled)) -= flat(Vec3Span(product));
      EXPECT_LT(norm(assembled), 1e-12 * norm(product));
    }
  }
}

TYPED_TEST(PointForce, rigidMotionIsFree) {
  const Body body = smallBody();
  const auto& X = body.cloud.positions;
  MlsElasticity<TypeParam> elasticity(makeMaterial<TypeParam>(), *body.bonds);
  double worst = 0;
  for (int degrees = 0; degrees <= 720; degrees += 15) {
    const Mat3 R = rotation(degrees * M_PI / 180, Vec3(1, -1, 2));
    const std::vector<Vec3> x = moved(X, R, Vec3(degrees, 1, -2));
    std::vector<Vec3> f(X.size(), Vec3::Zero());
    elasticity.addForces(x, f);
    for (const Vec3& v : f) worst = std::max(worst, v.norm() / youngModulus);
  }
  std::printf("largest force of a rigid motion over E s^2: %.2e\n", worst);
  if (std::is_same_v<TypeParam, HookeCauchy>)
    EXPECT_GT(worst, 0.1);  // infinitesimal strain takes a rotation for a deformation
  else
    EXPECT_LT(worst, 1e-10);
}

TYPED_TEST(PointForce, balancesItself) {
  const Body body = smallBody();
  const auto& X = body.cloud.positions;
  std::vector<Vec3> x = moved(X, rotation(2, Vec3(0, 1, 1)), Vec3::Zero());
  const std::vector<Vec3> noise = randomField(X.size(), 0.1, 12);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += noise[i];
  std::vector<Vec3> f(X.size(), Vec3::Zero());
  MlsElasticity<TypeParam> elasticity(makeMaterial<TypeParam>(), *body.bonds);
  elasticity.addForces(x, f);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    force += f[i];
    torque += x[i].cross(f[i]);
    size += f[i].norm();
  }
  EXPECT_LT(force.norm() / size, 1e-13);
  if (std::is_same_v<TypeParam, HookeCauchy>)
    EXPECT_GT(torque.norm() / size, 1e-3);
  else
    EXPECT_LT(torque.norm() / size, 1e-13);
}

TEST(LinearPatch, bothGradientsAreExactOnJitteredClouds) {
  Mat3 A;
  A << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
  for (const auto kind : {GradientKind::plain, GradientKind::fewIterations, GradientKind::exact}) {
    double worst = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      BodyOptions options;
      options.gradient = kind;
      const Body body(boxCloud({7, 6, 5}, 0.4, seed), options);
      MlsElasticity<HookeGreen> elasticity(HookeGreen(youngModulus, poissonRatio), *body.bonds);
      std::vector<Mat3> F(body.cloud.positions.size());
      elasticity.deformation(moved(body.cloud.positions, A, Vec3(1, 2, 3)), F);
      for (const Mat3& f : F) worst = std::max(worst, (f - A).cwiseAbs().maxCoeff());
    }
    std::printf("largest error of F: %.2e\n", worst);
    EXPECT_LT(worst, 1e-12);
  }
}

// A uniform stress must be met by its surface traction, and so displace the body linearly.
TEST(UniformTraction, isExactWithTheExactProjection) {
  Mat3 sigma;
  sigma << 3, 1, -2, 1, -1, 0.5, -2, 0.5, 2;
  const double lambda = Lame(youngModulus, poissonRatio).lambda,
               mu = Lame(youngModulus, poissonRatio).mu;
  const Mat3 strain =
      (sigma - lambda / (3 * lambda + 2 * mu) * sigma.trace() * Mat3::Identity()) / (2 * mu);
  for (const auto& [kind, name, bound] : {std::tuple{GradientKind::plain, "plain", 1.0},
                                          {GradientKind::fewIterations, "few iterations", 0.05},
                                          {GradientKind::secondOrder, "second order", 0.05},
                                          {GradientKind::exact, "exact", 1e-8}}) {
    BodyOptions options;
    options.gradient = kind;
    const Body body(boxCloud({7, 6, 5}, 0.4, 2), options);
    MlsElasticity<HookeCauchy> elasticity(HookeCauchy(youngModulus, poissonRatio), *body.bonds);
    const auto load = body.tractionForces([&](const Vec3&, const Vec3& n) { return sigma * n; });
    std::vector<Vec3> f(load),
        x = moved(body.cloud.positions, Mat3::Identity() + strain, Vec3::Zero());
    elasticity.addForces(x, f);
    const std::vector<Vec3> u =
        solveLinear(elasticity, body.cloud.positions, load, Springs(body.cloud.positions));
    std::vector<Vec3> y(u);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += body.cloud.positions[i];
    std::vector<Mat3> F(y.size());
    elasticity.deformation(y, F);
    double worst = 0;
    for (const Mat3& g : F) {
      const Mat3 e = 0.5 * (g + g.transpose()) - Mat3::Identity();
      worst = std::max(worst, (e - strain).norm() / strain.norm());
    }
    std::printf(
        "uniform traction, %s: unbalanced force %.2e of the load, largest strain error %.2e\n",
        name, norm(f) / norm(load), worst);
    EXPECT_LT(norm(f) / norm(load), bound);
    if (kind == GradientKind::exact) {
      EXPECT_LT(worst, 1e-8);
    }
  }
}

// u = x_a x_b: its gradient at a particle, integrated, is exact to the first moment with the
// weights and not with the volumes, because one-sided rows sample it elsewhere.
TEST(SecondOrder, weightsIntegrateGradientsThatVaryAndKeepLinearFieldsExact) {
  Cloud cloud = boxCloud({6, 6, 6}, 0.2, 4);
  SupportOptions support;
  Neighbourhoods n = findNeighbourhoods(cloud.positions, support);
  Gradients g = computeGradients(cloud.positions, n);
  const TransposedRows transposed = transpose(n);
  refitOneSided(cloud.positions, n, g);
  for (Index i = 0; i < n.particleCount(); ++i) {
    Mat3 one = Mat3::Zero();
    for (Index s = n.rows[i].begin; s < n.rows[i].begin + n.rows[i].size; ++s)
      one += (cloud.positions[n.neighbours[s]] - cloud.positions[i]) * g.values[s].transpose();
    EXPECT_LT((one - Mat3::Identity()).norm(), 1e-11);
  }
  const auto weights = quadratureWeights(cloud.positions, n, transposed, g, cloud.volumes);
  double volume = 0, weight = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_GE(weights[i], 0.25 * cloud.volumes[i]);
    volume += cloud.volumes[i];
    weight += weights[i];
  }
  EXPECT_NEAR(weight, volume, 1e-10 * volume);

  // squared stretch of a bent bar, u_x = (x - 3) (y - 3): the integral of (y - 3)^2
  const auto energy = [&](std::span<const double> at) {
    double sum = 0;
    for (Index i = 0; i < n.particleCount(); ++i) {
      double stretch = 0;
      const auto u = [&](Index a) {
        return (cloud.positions[a].x() - 3) * (cloud.positions[a].y() - 3);
      };
      for (Index s = n.rows[i].begin; s < n.rows[i].begin + n.rows[i].size; ++s)
        stretch += g.values[s].x() * (u(n.neighbours[s]) - u(i));
      sum += at[i] * stretch * stretch;
    }
    return sum / (6 * 6 * 18);
  };
  const double byVolumes = energy(cloud.volumes), byWeights = energy(weights);
  std::printf("squared stretch of a bent cube over the exact: volumes %.3f, weights %.3f\n",
              byVolumes, byWeights);
  EXPECT_LT(std::abs(byWeights - 1), 0.5 * std::abs(byVolumes - 1));
}

TEST(FreeBody, keepsBothMomentaOver10000Steps) {
  const Body body = smallBody();
  const auto& X = body.cloud.positions;
  MlsElasticity<HookeGreen> elasticity(HookeGreen(youngModulus, poissonRatio), *body.bonds);
  std::vector<Vec3> x(X), v = moved(X, Mat3::Zero(), Vec3(1, 0.5, 0)), f(X.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] += Vec3(0, 0.3, 1).cross(X[i]) + 0.5 * Vec3(std::sin(X[i].y()), 0, std::cos(X[i].x()));
  const auto momenta = [&] {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3 p = body.cloud.volumes[i] * v[i];
      linear += p;
      angular += x[i].cross(p);
    }
    return std::pair{linear, angular};
  };
  const auto [linear, angular] = momenta();
  const double step = 2e-3;
  for (int k = 0; k < 10000; ++k) {
    std::fill(f.begin(), f.end(), Vec3::Zero());
    elasticity.addForces(x, f);
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] += step * f[i] / body.cloud.volumes[i];
      x[i] += step * v[i];
    }
  }
  const auto [linearAfter, angularAfter] = momenta();
  const double drift = (linearAfter - linear).norm() / linear.norm();
  const double turn = (angularAfter - angular).norm() / angular.norm();
  std::printf("after 10000 steps: linear momentum off by %.2e, angular by %.2e\n", drift, turn);
  EXPECT_LT(drift, 1e-10);
  EXPECT_LT(turn, 1e-10);
}

TEST(RankLadder, countsEveryRungAndKeepsDegenerateTissueFinite) {
  const Body body = degenerateBody();
  const RankReport& report = body.gradients.report;
  std::printf("full %d (widened %d), coplanar %d, colinear %d, isolated %d\n", report.full,
              report.widened, report.coplanar, report.colinear, report.isolated);
  EXPECT_EQ(report.coplanar, 16);
  EXPECT_EQ(report.colinear, 5);
  EXPECT_EQ(report.isolated, 1);
  EXPECT_EQ(report.full, 64);

  // a rotation of everything completes to the rotation, and pushes nothing
  const Mat3 R = rotation(1.3, Vec3(2, -1, 1));
  const std::vector<Vec3> x = moved(body.cloud.positions, R, Vec3(1, 1, 1));
  MlsElasticity<HookeGreen> elasticity(HookeGreen(youngModulus, poissonRatio), *body.bonds);
  std::vector<Mat3> F(x.size());
  elasticity.deformation(x, F);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (body.gradients.rank[i] >= 2) {
      EXPECT_LT((F[i] - R).norm(), 1e-11);
    }
    EXPECT_LT((F[i].transpose() * F[i] - Mat3::Identity()).norm(), 1e-11);
  }
  std::vector<Vec3> f(x.size(), Vec3::Zero());
  elasticity.addForces(x, f);
  EXPECT_LT(norm(f), 1e-9 * youngModulus);
}

TEST(RankLadder, widensThinNeighbourhoods) {
  // four near-coplanar neighbours, and others beyond them
  std::vector<Vec3> X;
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) X.emplace_back(x, y + 0.01 * z, 3.0 * z + 0.18 * ((x + y) % 2));
  SupportOptions options;
  options.count = 6;
  Neighbourhoods n = findNeighbourhoods(X, options);
  const Gradients g = computeGradients(X, n);
  std::printf("widened %d of %zu\n", g.report.widened, X.size());
  EXPECT_GT(g.report.widened, 0);
  for (Index i = 0; i < n.particleCount(); ++i) {
    if (g.rank[i] != 3) continue;
    Mat3 sum = Mat3::Zero();
    for (Index s = n.rows[i].begin; s < n.rows[i].begin + n.rows[i].size; ++s)
      sum += (X[n.neighbours[s]] - X[i]) * g.values[s].transpose();
    EXPECT_LT((sum - Mat3::Identity()).norm(), 1e-10);
  }
}

TEST(Neighbourhood, countRadiusBoxAndEllipsoidAgreeWithBruteForce) {
  const Cloud cloud = boxCloud({5, 5, 5}, 0.4, 1);
  const auto& X = cloud.positions;
  std::vector<EllipsoidAxes> axes(X.size(), {Vec3(0.6, 0, 0.8), 1.0, 0.4});
  for (const auto shape : {SupportShape::ball, SupportShape::box, SupportShape::ellipsoid})
    for (const Index count : {0, 10}) {
      SupportOptions options;
      options.shape = shape;
      options.count = count;
      options.radius = 1.7;
      const Neighbourhoods n = findNeighbourhoods(X, options, axes);
      for (Index i = 0; i < n.particleCount(); ++i) {
        std::vector<std::pair<double, Index>> all;
        for (Index j = 0; j < n.particleCount(); ++j)
          if (j != i) all.emplace_back(n.distance(i, X[j] - X[i]), j);
        std::sort(all.begin(), all.end());
        if (count > 0)
          all.resize(count);
        else
          std::erase_if(all, [](const auto& c) { return c.first >= 1.7; });
        ASSERT_EQ(all.size(), n.neighboursOf(i).size());
        for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k].second, n.neighboursOf(i)[k]);
      }
    }
}

TEST(Neighbourhood, rowsCanBeReplacedWithoutMovingOthers) {
  const Cloud cloud = boxCloud({4, 4, 4}, 0.4, 1);
  SupportOptions options;
  options.spare = 2;
  Neighbourhoods n = findNeighbourhoods(cloud.positions, options);
  const std::vector<Index> next(n.neighboursOf(6).begin(), n.neighboursOf(6).end());
  std::vector<Index> ids(14);
  std::vector<double> weights(14, 0.5);
  for (Index k = 0; k < 14; ++k) ids[k] = 20 + k;
  const Index begin = n.rows[5].begin;
  n.assignRow(5, ids, weights);
  EXPECT_EQ(n.rows[5].begin, begin);
  EXPECT_EQ(n.rows[5].size, 14);
  ids.resize(30, 1);
  weights.resize(30, 0.1);
  n.assignRow(5, ids, weights);
  EXPECT_EQ(n.neighboursOf(5).size(), 30u);
  EXPECT_TRUE(std::equal(next.begin(), next.end(), n.neighboursOf(6).begin()));
}

TEST(Neighbourhood, refusesWhatDefinesNoSupport) {
  std::vector<Vec3> X{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  SupportOptions options;
  options.count = 0;
  EXPECT_THROW(static_cast<void>(findNeighbourhoods(X, options)), std::invalid_argument);
  options.count = 3;
  options.shape = SupportShape::ellipsoid;
  EXPECT_THROW(static_cast<void>(findNeighbourhoods(X, options)), std::invalid_argument);
  options.shape = SupportShape::ball;
  EXPECT_EQ(findNeighbourhoods(X, options).neighboursOf(0).size(), 1u);
  X[1].x() = std::nan("");
  EXPECT_THROW(static_cast<void>(findNeighbourhoods(X, options)), std::invalid_argument);
}

TEST(SurfaceShape, goesBackByItsExactTransposeAndMovesLinearFieldsExactly) {
  for (const Index supports : {1, 4, 12}) {
    const Body body = smallBody();
    const SurfaceShape shape(body.cloud.positions, body.neighbourhoods, body.gradients,
                             body.cloud.nodes, supports);
    const std::vector<Vec3> u = randomField(body.cloud.positions.size(), 1, 20);
    const std::vector<Vec3> force = randomField(body.cloud.nodes.size(), 1, 21);
    std::vector<Vec3> us(force.size()), back(u.size(), Vec3::Zero());
    shape.apply(u, us);
    shape.addTransposed(force, back);
    const double adjoint = std::abs(dot(force, us) - dot(back, u)) / (norm(force) * norm(us));
    Mat3 A;
    A << 1, 2, 3, -1, 0.5, 0, 0.3, 0, -2;
    shape.apply(moved(body.cloud.positions, A, Vec3(1, -2, 3)), us);
    const std::vector<Vec3> expected = moved(body.cloud.nodes, A, Vec3(1, -2, 3));
    double worst = 0;
    for (std::size_t s = 0; s < us.size(); ++s)
      worst = std::max(worst, (us[s] - expected[s]).norm());
    std::printf("%d supports: adjoint error %.1e, linear field error %.1e\n", supports, adjoint,
                worst);
    EXPECT_LT(adjoint, 1e-12);
    EXPECT_LT(worst, 1e-11);
    for (Index s = 0; s < shape.pointCount(); ++s) {
      double sum = 0;
      for (const ShapeEntry& e : shape.shapeOf(s)) sum += e.weight;
      EXPECT_NEAR(sum, 1, 1e-12);
    }
  }
}

TEST(SurfaceQuadrature, integratesLinearFieldsExactly) {
  const Cloud cloud = boxCloud({3, 4, 5}, 0.2, 1);
  EXPECT_NEAR(enclosedVolume(cloud.nodes, cloud.triangles), 60, 1e-12);
  for (const double edge : {0.0, 0.7, 0.2}) {
    Vec3 sum = Vec3::Zero();
    Mat3 moment = Mat3::Zero();
    for (const SurfaceSample& s : sampleSurface(cloud.nodes, cloud.triangles, edge)) {
      sum += s.area;
      moment += s.position * s.area.transpose();
      EXPECT_NEAR(s.barycentric.sum(), 1, 1e-14);
    }
    EXPECT_LT(sum.norm(), 1e-11);
    EXPECT_LT((moment - 60 * Mat3::Identity()).norm(), 1e-10);
  }
}

TEST(ConsistentGradient, localProjectionRestoresPartOfTheRows) {
  BodyOptions options;
  options.gradient = GradientKind::plain;
  Body body(boxCloud({6, 6, 6}, 0.4, 5), options);
  std::vector<Vec3> areas, boundary(body.cloud.positions.size(), Vec3::Zero());
  for (const SurfaceSample& s : body.samples) areas.push_back(s.area);
  body.shape.addTransposed(areas, boundary);
  std::vector<Index> rows;
  for (Index i = 0; i < body.neighbourhoods.particleCount(); ++i)
    if (body.cloud.positions[i].x() < 3) rows.push_back(i);
  const std::vector<Vec3> before = body.gradients.values;
  ProjectionOptions projection;
  projection.iterations = 20;
  const ProjectionReport report =
      makeConsistentLocally(body.cloud.positions, body.neighbourhoods, body.transposed,
                            body.cloud.volumes, boundary, rows, body.gradients, projection);
  std::printf("residual %.3f -> %.3f with half the rows\n", report.residualBefore,
              report.residualAfter);
  EXPECT_LT(report.residualAfter, 0.8 * report.residualBefore);
  for (Index i = 0; i < body.neighbourhoods.particleCount(); ++i) {
    const Row& row = body.neighbourhoods.rows[i];
    Mat3 sum = Mat3::Zero();
    for (Index s = row.begin; s < row.begin + row.size; ++s) {
      const Index j = body.neighbourhoods.neighbours[s];
      sum += (body.cloud.positions[j] - body.cloud.positions[i]) *
             body.gradients.values[s].transpose();
      if (body.cloud.positions[i].x() >= 3) {
        EXPECT_EQ(before[s], body.gradients.values[s]);
      }
    }
    EXPECT_LT((sum - Mat3::Identity()).norm(), 1e-10);
  }
}

TEST(ConsistentGradient, localProjectionOfAllRowsIsTheGlobalOne) {
  BodyOptions options;
  options.gradient = GradientKind::plain;
  Body body(boxCloud({6, 6, 6}, 0.4, 5), options);
  const auto& X = body.cloud.positions;
  std::vector<Vec3> areas, boundary(X.size(), Vec3::Zero());
  for (const SurfaceSample& s : body.samples) areas.push_back(s.area);
  body.shape.addTransposed(areas, boundary);
  std::vector<Index> rows;
  for (Index i = 0; i < body.neighbourhoods.particleCount(); ++i) rows.push_back(i);
  Gradients local = body.gradients, global = body.gradients;
  makeConsistentLocally(X, body.neighbourhoods, body.transposed, body.cloud.volumes, boundary, rows,
                        local);
  makeConsistent(X, body.neighbourhoods, body.transposed, body.cloud.volumes, boundary, global);
  EXPECT_EQ(local.values, global.values);
}

TEST(Stability, powerIterationFindsTheLargestEigenfrequency) {
  const Body body = smallBody();
  const auto& X = body.cloud.positions;
  MlsElasticity<HookeGreen> elasticity(HookeGreen(youngModulus, poissonRatio), *body.bonds);
  elasticity.prepareTangent(X);
  std::vector<double> masses(body.cloud.volumes);
  const auto product = [&](ConstVec3Span x, Vec3Span y) {
    std::fill(y.begin(), y.end(), Vec3::Zero());
    elasticity.addStiffnessProduct(1, x, y);
  };
  const double few = largestEigenfrequencySquared(masses, product);
  const double many = largestEigenfrequencySquared(masses, product, 2000);
  std::printf("omega^2 after 40 iterations %.6g, converged %.6g, critical step %.4g s\n", few, many,
              criticalTimeStep(many));
  EXPECT_GT(few, 0.8 * many);
  EXPECT_EQ(few, largestEigenfrequencySquared(masses, product));

  // just below the critical step a small vibration stays small, above it grows without bound
  for (const auto& [factor, stable] : {std::pair{0.95, true}, {1.05, false}}) {
    const double step = factor * criticalTimeStep(many);
    std::vector<Vec3> x(X), v = randomField(X.size(), 1e-6, 30), f(X.size());
    for (int k = 0; k < 2000; ++k) {
      std::fill(f.begin(), f.end(), Vec3::Zero());
      elasticity.addForces(x, f);
      for (std::size_t i = 0; i < x.size(); ++i) {
        v[i] += step * f[i] / masses[i];
        x[i] += step * v[i];
      }
    }
    EXPECT_EQ(norm(v) < 1e-2, stable);
  }
}

}  // namespace
}  // namespace stroma::test
