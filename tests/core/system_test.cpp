// SPDX-License-Identifier: Apache-2.0
#include "core/system.h"

#include <gtest/gtest.h>

#include <random>

#include "core/parallel.h"
#include "test_components.h"

namespace stroma::test {
namespace {

const std::string twoBodies = R"(<Node gravity="0 0 -2"><SymplecticEuler/>
  <Node name="one"><Points position="1 0 0  2 0 0"/><UnitMass/><Tether stiffness="3"/>
    <Node name="half"><Points/><HalfMapping/><Tether stiffness="10"/></Node></Node>
  <Node name="two" gravity="0 0 0"><Points position="0 5 0"/><UnitMass/><Tether stiffness="7"/></Node>
  </Node>)";

std::string filled() {
  std::string xml = twoBodies;
  xml.replace(xml.find("<Points/>"), 9, "<Points position=\"0 0 0 0 0 0\"/>");
  return xml;
}

TEST(System, concatenatesStatesAndMapsForcesBack) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, filled())) << scene->diagnostics().text();
  System& s = *scene->systems()[0];
  ASSERT_EQ(s.size(), 3);
  s.computeForce({s.x(), s.v(), 0}, s.f());
  // -3 x - 10/4 x from the mapped half, and gravity of the node
  EXPECT_TRUE(s.f()[0].isApprox(Vec3(-5.5, 0, -2)));
  EXPECT_TRUE(s.f()[2].isApprox(Vec3(0, -35, 0)));
  EXPECT_NEAR(s.potentialEnergy({s.x(), s.v(), 0}), 0.5 * 3 * 5 + 0.5 * 10 * 5 / 4 + 0.5 * 7 * 25,
              1e-12);
}

TEST(System, tangentProductMatchesForceDifferences) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, filled()));
  System& s = *scene->systems()[0];
  std::vector<Vec3> dx(3), df(3, Vec3::Zero()), f0(3), f1(3), x(s.x().begin(), s.x().end());
  for (std::size_t i = 0; i < 3; ++i) dx[i] = Vec3(0.3, -0.1, 0.7) * static_cast<double>(i + 1);
  s.linearize({x, s.v(), 0});
  s.addTangentProduct(dx, 1, 0, df);
  s.computeForce({x, s.v(), 0}, f0);
  for (std::size_t i = 0; i < 3; ++i) x[i] += dx[i];
  s.computeForce({x, s.v(), 0}, f1);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE((f1[i] - f0[i]).isApprox(df[i], 1e-12));
}

TEST(BlockMatrix, projectsAndConvertsLikeADenseMatrix) {
  BlockPattern pattern(4);
  const std::vector<Index> clique = {0, 2, 3};
  pattern.addClique(clique);
  pattern.add(1, 2);
  BlockMatrix blocks(std::move(pattern));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(12, 12);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto add = [&](Index i, Index j) {
    Mat3 block = Mat3::NullaryExpr([&] { return uniform(random); });
    if (i == j) block = (block + block.transpose()).eval();
    blocks.add(i, j, block);
    blocks.add(j, i, block.transpose());
    dense.block<3, 3>(3 * i, 3 * j) += i == j ? Mat3(2 * block) : block;
    if (i != j) dense.block<3, 3>(3 * j, 3 * i) += block.transpose();
  };
  add(0, 0), add(2, 0), add(3, 2), add(1, 2), add(1, 1), add(0, 3);
  blocks.addDiagonal(1, 5);
  dense.block<3, 3>(3, 3) += 5 * Mat3::Identity();
  const Vec3 n = Vec3(1, 2, 3).normalized();
  const Mat3 projector = Mat3::Identity() - n * n.transpose();
  blocks.project(2, projector);
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(12, 12);
  P.block<3, 3>(6, 6) = projector;
  dense = P * dense * P + (Eigen::MatrixXd::Identity(12, 12) - P);
  const Eigen::MatrixXd lower = blocks.lower();
  EXPECT_LT((lower - Eigen::MatrixXd(dense.triangularView<Eigen::Lower>())).norm(), 1e-13);
}

TEST(Parallel, sumsHaveTheSameBitsAtAnyThreadCount) {
  std::vector<double> a(100'003);
  std::mt19937 random(7);
  for (double& value : a) value = std::uniform_real_distribution<double>(-1, 1)(random);
  const auto sum = [&] {
    return parallelSum(static_cast<Index>(a.size()), 0.0, [&](Index begin, Index end) {
      double s = 0;
      for (Index i = begin; i < end; ++i) s += a[static_cast<std::size_t>(i)];
      return s;
    });
  };
  setThreadCount(1);
  const double one = sum();
  for (const int threads : {2, 3, 8}) {
    setThreadCount(threads);
    EXPECT_EQ(sum(), one) << threads;
  }
  setThreadCount(1);
}

}  // namespace
}  // namespace stroma::test
