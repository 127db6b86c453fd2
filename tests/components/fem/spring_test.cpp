// SPDX-License-Identifier: Apache-2.0
#include "components/fem/mesh_springs.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/components/fem/element_body.h"

namespace stroma::test {
namespace {

std::vector<Spring> edgesOf(const RegularGrid& grid) {
  std::vector<Spring> springs;
  for (const Edge& e : grid.edges) {
    const auto k = static_cast<double>(springs.size());
    springs.push_back({e, 10 + k, 0.3 + 0.01 * k, 1});
  }
  return springs;
}

struct Net {
  RegularGrid grid = makeRegularGrid({3, 3, 3}, Vec3::Zero(), Vec3(2, 2, 2));
  Index count = static_cast<Index>(grid.positions.size());
  MeshSprings springs{count, edgesOf(grid), false};
  std::vector<Vec3> x = randomField(grid.positions.size(), 0.2, 1), rest = x;

  Net() {
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += grid.positions[i];
      rest[i].setZero();
    }
  }
  std::vector<Vec3> force(ConstVec3Span at, ConstVec3Span v) const {
    std::vector<Vec3> f(at.size(), Vec3::Zero());
    springs.addForces(at, v, f);
    return f;
  }
  std::vector<Vec3> product(ConstVec3Span dx, double stiffness, double damping) const {
    std::vector<Vec3> df(dx.size(), Vec3::Zero());
    springs.addTangentProduct(dx, stiffness, damping, df);
    return df;
  }
};

TEST(MeshSprings, twoNodesPullAsTheFormulaSays) {
  const std::vector<Spring> one{{{0, 1}, 50, 4, 2}};
  const MeshSprings springs(2, one, false);
  const std::vector<Vec3> x{{1, 1, 1}, {1, 4, 5}}, v{{0, 0, 0}, {7, 3, 4}};
  std::vector<Vec3> f(2, Vec3::Zero());
  springs.addForces(x, v, f);
  // length 5, direction (0, .6, .8), lengthening at 5
  const Vec3 expected = (50 * 3 + 4 * 5) * Vec3(0, 0.6, 0.8);
  EXPECT_LT((f[0] - expected).norm(), 1e-13 * expected.norm());
  EXPECT_EQ(f[0], -f[1]);
  EXPECT_DOUBLE_EQ(springs.energy(x), 0.5 * 50 * 9);
}

TEST(MeshSprings, withoutCompressionShorterOnesAreSlack) {
  const std::vector<Spring> one{{{0, 1}, 50, 4, 2}};
  MeshSprings springs(2, one, true);
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}}, v{{0, 0, 0}, {7, 3, 4}};
  std::vector<Vec3> f(2, Vec3::Zero());
  springs.addForces(x, v, f);
  springs.prepareTangent(x, false);
  springs.addTangentProduct(v, 1, 1, f);
  EXPECT_EQ(f[0].norm() + f[1].norm(), 0);
  EXPECT_EQ(springs.energy(x), 0);
}

TEST(MeshSprings, forceIsMinusEnergyGradientAndTangentItsDerivative) {
  Net net;
  const std::vector<Vec3> d = randomField(net.x.size(), 1, 2), f = net.force(net.x, net.rest);
  const double h = 1e-6;
  std::vector<Vec3> more(net.x), less(net.x);
  flat(Vec3Span(more)) += h * flat(ConstVec3Span(d));
  flat(Vec3Span(less)) -= h * flat(ConstVec3Span(d));
  const double slope = (net.springs.energy(more) - net.springs.energy(less)) / (2 * h);
  const double work = flat(ConstVec3Span(f)).dot(flat(ConstVec3Span(d)));
  net.springs.prepareTangent(net.x, false);
  const std::vector<Vec3> Kd = net.product(d, 1, 0), Cd = net.product(d, 0, 1);
  const std::vector<Vec3> fm = net.force(more, net.rest), fl = net.force(less, net.rest),
                          fv = net.force(net.x, d);
  double stiffness = 0, damping = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    stiffness += ((fm[i] - fl[i]) / (2 * h) - Kd[i]).squaredNorm();
    damping += (fv[i] - f[i] - Cd[i]).squaredNorm();
  }
  std::printf("energy %.1e, stiffness %.1e, damping %.1e\n", std::abs(slope / work + 1),
              std::sqrt(stiffness) / norm(Kd), std::sqrt(damping) / norm(Cd));
  EXPECT_NEAR(slope / work, -1, 1e-7);
  EXPECT_LT(std::sqrt(stiffness), 1e-6 * norm(Kd));
  EXPECT_LT(std::sqrt(damping), 1e-12 * norm(Cd));
}

TEST(MeshSprings, filteredTangentIsPositiveAndBlocksEqualProducts) {
  Net net;
  net.springs.prepareTangent(net.x, true);
  BlockPattern pattern(net.count);
  net.springs.addPattern(pattern, 0);
  BlockMatrix matrix(std::move(pattern));
  net.springs.addTangent(matrix, 0, -2, -3);
  const Eigen::MatrixXd K = Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
  const std::vector<Vec3> d = randomField(net.x.size(), 1, 3), Kd = net.product(d, -2, -3);
  EXPECT_LT((K * flat(ConstVec3Span(d)) - flat(ConstVec3Span(Kd))).norm(), 1e-13 * norm(Kd));
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  EXPECT_GT(values.minCoeff(), -1e-13 * values.maxCoeff());
}

TEST(MeshSprings, keepMomenta) {
  const Net net;
  const std::vector<Vec3> v = randomField(net.x.size(), 1, 4), f = net.force(net.x, v);
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (std::size_t i = 0; i < f.size(); ++i) {
    sum += f[i];
    torque += net.x[i].cross(f[i]);
  }
  EXPECT_LT(sum.norm(), 1e-14 * norm(f) * 27);
  EXPECT_LT(torque.norm(), 1e-14 * norm(f) * 27);
}

}  // namespace
}  // namespace stroma::test
