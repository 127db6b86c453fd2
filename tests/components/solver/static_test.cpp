// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/components/solver/test_scene.h"

namespace stroma::test {
namespace {

// Root of k u + c u^3 = force, by bisection.
double exactStretch(double k, double c, double force) {
  double low = 0, high = force / k;
  for (int i = 0; i < 200; ++i) {
    const double u = 0.5 * (low + high);
    (k * u + c * u * u * u > force ? high : low) = u;
  }
  return low;
}

std::string pulled(const std::string& attributes, const std::string& linear) {
  return dtNode(1, "<StaticSolver " + attributes + "/>" + linear +
                       "<MechanicalObject position='0 0 0 1 0 0'/>"
                       "<StiffeningSprings k='10' c='1e5'/>"
                       "<ConstantForceField forces='3 4 0 0 0 -2'/>");
}

TEST(StaticSolver, solvesStiffeningSprings) {
  for (const std::string linear : {"<SparseLDLSolver/>", "<CGLinearSolver tolerance='1e-10'/>"}) {
    Loaded s = load(pulled("tolerance='1e-12'", linear));
    s.run(1);
    const auto& solver = s.find<StaticSolver>();
    const Vec3 u = s.system().x()[0], w = s.system().x()[1] - Vec3(1, 0, 0);
    const double error = (u - exactStretch(10, 1e5, 5) * Vec3(0.6, 0.8, 0)).norm();
    std::printf("%d Newton iterations, error %.1e m\n", solver.lastNewtonIterations.value(), error);
    EXPECT_LT(error, 1e-12);
    EXPECT_LT((w - exactStretch(10, 1e5, 2) * Vec3(0, 0, -1)).norm(), 1e-12);
    EXPECT_EQ(limiter(solver, "notConverged"), 0u);
    EXPECT_EQ(limiter(solver, "lineSearchFailed"), 0u);
    // the second step starts at equilibrium
    s.run(1);
    EXPECT_EQ(solver.lastNewtonIterations, 0);
  }
}

TEST(StaticSolver, unconvergedSolveIsCounted) {
  Loaded s = load(pulled("newtonIterations='2'", "<SparseLDLSolver/>"));
  s.run(1);
  EXPECT_EQ(limiter(s.find<StaticSolver>(), "notConverged"), 1u);
  EXPECT_GT(s.find<StaticSolver>().lastResidual, 1e-6);
}

// A hanging chain that starts horizontal has no stiffness against its load: the matrix is singular
// there.
TEST(StaticSolver, findsTheHangingChain) {
  Loaded s = load(dtNode(1,
                         "<StaticSolver newtonIterations='300' tolerance='1e-10'/>"
                         "<SparseLDLSolver/><MechanicalObject position='" +
                             line(11, 0.1) +
                             "'/><UniformMass vertexMass='0.1'/><Chain k='1000'/>"
                             "<FixedProjectiveConstraint indices='0'/>",
                         "0 -10 0"));
  s.run(1);
  const auto& solver = s.find<StaticSolver>();
  double y = 0;
  for (int i = 1; i <= 10; ++i) y -= 0.1 + (11 - i) * 0.1 * 10 / 1000;
  std::printf("hanging chain: %d Newton iterations, end at %.6f (exact %.6f), %d shifts\n",
              solver.lastNewtonIterations.value(), s.system().x()[10].y(), y,
              static_cast<int>(limiter(s.find<SparseLDLSolver>(), "shifted")));
  EXPECT_NEAR(s.system().x()[10].y(), y, 1e-8);
  EXPECT_EQ(limiter(solver, "notConverged"), 0u);
}

TEST(StaticSolver, velocitiesAreZeroAndMassesNotNeeded) {
  Loaded s = load(dtNode(1,
                         "<StaticSolver/><SparseLDLSolver/><MechanicalObject position='0 0 0' "
                         "velocity='1 0 0'/><RestShapeSpringsForceField points='0' "
                         "stiffness='10'/><ConstantForceField totalForce='1 0 0'/>"));
  s.run(1);
  EXPECT_EQ(s.system().v()[0], Vec3(0, 0, 0));
  EXPECT_NEAR(s.system().x()[0].x(), 0.1, 1e-13);
}

}  // namespace
}  // namespace stroma::test
