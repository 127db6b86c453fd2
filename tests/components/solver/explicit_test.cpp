// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "tests/components/solver/test_scene.h"

namespace stroma::test {
namespace {

// One particle of 0.5 kg on a spring of 200 N/m along x: w = 20/s, started at 0.1 m from rest.
constexpr double k = 200, m = 0.5, omega = 20;

std::string oscillator(double dt, const std::string& solver, double v = 0) {
  return dtNode(dt, solver +
                        "<MechanicalObject position='0.1 0 0' rest_position='0 0 0' velocity='" +
                        std::to_string(v) +
                        " 0 0'/><UniformMass totalMass='0.5'/><StiffeningSprings k='200'/>");
}

// Position after one second; with a start velocity half a step back it is leapfrog's.
double errorAtOneSecond(int steps, bool leapfrog, const std::string& attributes) {
  const double h = 1.0 / steps;
  Loaded s = load(oscillator(h, "<EulerExplicitSolver substeps='1' " + attributes + "/>"));
  // v(-h/2) of the exact motion
  if (leapfrog) s.system().v()[0].x() = 0.1 * omega * std::sin(omega * h / 2);
  s.run(steps);
  return std::abs(s.system().x()[0].x() - 0.1 * std::cos(omega));
}

TEST(EulerExplicit, freeFallIsTheDiscreteParabola) {
  const double h = 1e-3;
  Loaded s = load(dtNode(h,
                         "<EulerExplicitSolver substeps='1'/><MechanicalObject position='0 0 0' "
                         "velocity='1 0 0'/><UniformMass totalMass='2'/>",
                         "0 -10 0"));
  const int n = 1000;
  s.run(n);
  EXPECT_NEAR(s.system().v()[0].y(), -10.0, 1e-12);
  EXPECT_NEAR(s.system().x()[0].y(), -10 * h * h * n * (n + 1) / 2, 1e-12);
  EXPECT_NEAR(s.system().x()[0].x(), 1.0, 1e-12);
}

TEST(EulerExplicit, symplecticIsFirstOrderAndSecondOrderAsLeapfrog) {
  const double first = errorAtOneSecond(2000, false, ""), half = errorAtOneSecond(4000, false, "");
  const double frog = errorAtOneSecond(2000, true, ""), halfFrog = errorAtOneSecond(4000, true, "");
  const double plain = errorAtOneSecond(20000, false, "symplectic='false'");
  const double halfPlain = errorAtOneSecond(40000, false, "symplectic='false'");
  std::printf("order: symplectic %.3f, leapfrog start %.3f, plain %.3f\n", std::log2(first / half),
              std::log2(frog / halfFrog), std::log2(plain / halfPlain));
  EXPECT_NEAR(std::log2(first / half), 1, 0.05);
  EXPECT_NEAR(std::log2(frog / halfFrog), 2, 0.05);
  EXPECT_NEAR(std::log2(plain / halfPlain), 1, 0.05);
}

TEST(EulerExplicit, energyStaysBounded) {
  const double h = 0.5 * 2 / omega;
  Loaded s = load(oscillator(h, "<EulerExplicitSolver substeps='1'/>"));
  double most = 0;
  for (int i = 0; i < 100000; ++i) {
    ASSERT_TRUE(s.scene->step());
    // the invariant of symplectic Euler: energy plus h/2 k x v
    const double x = s.system().x()[0].x(), v = s.system().v()[0].x();
    const double energy = 0.5 * m * v * v + 0.5 * k * x * x - 0.5 * h * k * x * v;
    most = std::max(most, std::abs(energy / (0.5 * k * 0.01) - 1));
  }
  std::printf("largest relative change of the invariant in 100,000 steps: %.2e\n", most);
  EXPECT_LT(most, 1e-10);
}

TEST(EulerExplicit, dampedOscillatorDecaysAsTheAnalyticOne) {
  const double rM = 1.0, rK = 0.004, damping = (rM + rK * omega * omega) / 2;
  const double w = std::sqrt(omega * omega - damping * damping);
  const double exact = 0.1 * std::exp(-damping) * (std::cos(w) + damping / w * std::sin(w));
  const auto error = [&](int steps) {
    Loaded s = load(oscillator(
        1.0 / steps,
        "<EulerExplicitSolver substeps='1' rayleighMass='1' rayleighStiffness='0.004'/>"));
    s.run(steps);
    return s.system().x()[0].x() - exact;
  };
  const double coarse = error(4000), fine = error(8000);
  std::printf("damped oscillator: error %.2e of 0.1, order %.3f, extrapolated error %.1e\n", fine,
              std::log2(coarse / fine), 2 * fine - coarse);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.05);
  EXPECT_LT(std::abs(2 * fine - coarse), 1e-6);
}

TEST(EulerExplicit, estimateFindsTheHighestFrequencyOfAChain) {
  const int n = 60;
  Loaded s = load(dtNode(1e-3, "<EulerExplicitSolver/><MechanicalObject position='" + line(n, 0.1) +
                                   "'/><UniformMass vertexMass='0.01'/><Chain k='100'/>"
                                   "<FixedProjectiveConstraint indices='0 " +
                                   std::to_string(n - 1) + "'/>"));
  const int free = n - 2;
  const double highest =
      2 * std::sqrt(100 / 0.01) * std::sin(std::numbers::pi * free / (2 * (free + 1)));
  const double found = s.find<EulerExplicitSolver>().stableStep, exact = 2 / highest;
  std::printf("largest stable step %.4e s, exact %.4e s\n", found, exact);
  EXPECT_GE(found, exact * (1 - 1e-9));
  EXPECT_LT(found, exact * 1.05);
}

TEST(EulerExplicit, dampingShortensTheStableStepAsEstimated) {
  const std::string damped =
      "<EulerExplicitSolver substeps='1' rayleighMass='3' "
      "rayleighStiffness='0.02'/>";
  const double limit = load(oscillator(1e-4, damped)).find<EulerExplicitSolver>().stableStep;
  EXPECT_LT(limit, 0.9 * 2 / omega);
  for (const double factor : {0.99, 1.01}) {
    Loaded s = load(oscillator(factor * limit, damped));
    s.run(400);
    const double size = s.system().x()[0].norm();
    std::printf("after 400 steps of %.2f of the limit: %.2e\n", factor, size);
    EXPECT_EQ(size < 0.1, factor < 1);
  }
}

TEST(EulerExplicit, subStepsFollowStiffeningAndAreShown) {
  Loaded s = load(
      dtNode(0.05,
             "<EulerExplicitSolver estimateEvery='1' rayleighMass='5'/><MechanicalObject "
             "position='0 0 0'/><UniformMass totalMass='0.5'/><StiffeningSprings k='200' c='1e5'/>"
             "<ConstantForceField name='load' totalForce='0 0 0'/>"));
  auto& solver = s.find<EulerExplicitSolver>();
  const int before = solver.currentSubsteps;
  EXPECT_EQ(before, 1);
  for (int i = 1; i <= 400; ++i) {
    ASSERT_FALSE(s.scene->setAttribute("/load.totalForce", std::to_string(0.1 * i) + " 0 0"));
    s.run(1);
  }
  s.run(200);
  std::printf("sub-steps %d -> %d, %d changes\n", before, solver.currentSubsteps.value(),
              solver.substepChanges.value());
  EXPECT_GT(solver.currentSubsteps, before);
  EXPECT_GT(solver.substepChanges, 0);
  const double x = s.system().x()[0].x();
  EXPECT_NEAR(200 * x + 1e5 * x * x * x, 40, 0.01);
}

TEST(EulerExplicit, stiffnessChangedAtRunTimeIsFollowedAtOnce) {
  Loaded s = load(oscillator(0.05, "<EulerExplicitSolver estimateEvery='1000000'/>"));
  s.run(10);
  const auto& springs = s.find<StiffeningSprings>();
  ASSERT_FALSE(s.scene->setAttribute("/" + springs.name() + ".k", "2e6"));
  s.run(100);
  const double size = s.system().x()[0].norm();
  const int substeps = s.find<EulerExplicitSolver>().currentSubsteps;
  std::printf("10,000 times stiffer: %d sub-steps, amplitude %.3f\n", substeps, size);
  EXPECT_LT(size, 0.2);
  EXPECT_GT(substeps, 30);
}

TEST(EulerExplicit, capOnSubStepsIsCounted) {
  Loaded s = load(oscillator(1.0, "<EulerExplicitSolver maxSubsteps='3'/>"));
  EXPECT_EQ(limiter(s.find<EulerExplicitSolver>(), "maxSubsteps"), 1u);
}

TEST(EulerExplicit, unstableSubStepsAreWarnedOf) {
  Loaded s = load(oscillator(0.2, "<EulerExplicitSolver substeps='1'/>"));
  EXPECT_NE(s.text().find("longer than the largest stable one"), std::string::npos) << s.text();
}

TEST(EulerExplicit, heldParticlesKeepTheirBits) {
  Loaded s = load(dtNode(1e-3,
                         "<EulerExplicitSolver/><MechanicalObject position='0.1 0.2 0.3 1 1 1' "
                         "velocity='1 1 1'/><UniformMass vertexMass='1'/>"
                         "<FixedProjectiveConstraint indices='0'/>",
                         "0 -10 0"));
  s.run(10);
  EXPECT_EQ(s.system().x()[0], Vec3(0.1, 0.2, 0.3));
  EXPECT_NEAR(s.system().f()[0].y(), -10, 1e-12) << "the force on it shows the reaction";
  EXPECT_LT(s.system().v()[1].y(), 1);
}

TEST(EulerExplicit, masslessParticleIsNamed) {
  const Loaded s = tryLoad(
      dtNode(1e-3, "<EulerExplicitSolver/><MechanicalObject name='body' position='0 0 0'/>"));
  EXPECT_FALSE(s.ready);
  EXPECT_NE(s.text().find("/body, particle 0 has none"), std::string::npos) << s.text();
}

// A spring that is a thousand times stiffer a step later: the estimate at the start knows nothing
// of it.
TEST(EulerExplicit, aStepInWhichTissueStiffensIsMadeAgain) {
  Loaded s = load(dtNode(0.1,
                         "<EulerExplicitSolver/><MechanicalObject position='0 0 0  1 0 0' "
                         "velocity='30 0 0'/><UniformMass vertexMass='0.5'/>"
                         "<StiffeningSprings k='20' c='4e3'/>"));
  System& system = s.system();
  const auto energy = [&] {
    return system.kineticEnergy(system.v()) +
           system.potentialEnergy({system.x(), system.v(), s.scene->time()});
  };
  const double start = energy();
  double most = 0;
  for (int step = 0; step < 200; ++step) {
    ASSERT_TRUE(s.scene->step()) << "step " << step;
    most = std::max(most, energy() / start);
  }
  std::printf("energy at most %.4f of that at the start, %llu steps made again\n", most,
              static_cast<unsigned long long>(limiter(s.find<EulerExplicitSolver>(), "repeated")));
  EXPECT_LT(most, 1.1);
  EXPECT_GT(limiter(s.find<EulerExplicitSolver>(), "repeated"), 0u);
}

TEST(EulerExplicit, aLoadThatSetsInIsNoStiffness) {
  Loaded s = load(oscillator(0.02, "<EulerExplicitSolver/><ConstantForceField forces='50 0 0'/>"));
  s.run(100);
  EXPECT_EQ(limiter(s.find<EulerExplicitSolver>(), "repeated"), 0u);
}

}  // namespace
}  // namespace stroma::test
