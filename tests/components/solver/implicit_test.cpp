// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/components/solver/test_scene.h"

namespace stroma::test {
namespace {

const std::string tightCg = "<CGLinearSolver tolerance='1e-13' iterations='500'/>";

std::string oscillator(double dt, const std::string& attributes) {
  return dtNode(dt, "<EulerImplicitSolver " + attributes + "/>" + tightCg +
                        "<MechanicalObject position='0.1 0 0' rest_position='0 0 0'/>"
                        "<UniformMass totalMass='0.5'/><StiffeningSprings k='200'/>");
}

double dampedError(int steps, const std::string& attributes) {
  const double omega = 20, damping = (1.0 + 0.004 * omega * omega) / 2;
  const double w = std::sqrt(omega * omega - damping * damping);
  Loaded s =
      load(oscillator(1.0 / steps, "rayleighMass='1' rayleighStiffness='0.004' " + attributes));
  s.run(steps);
  const double exact = 0.1 * std::exp(-damping) * (std::cos(w) + damping / w * std::sin(w));
  return s.system().x()[0].x() - exact;
}

TEST(EulerImplicit, dampedOscillatorConvergesWithTheExpectedOrder) {
  struct Case {
    std::string attributes;
    double order;
  };
  for (const auto& [attributes, order] :
       {Case{"", 1}, Case{"newtonIterations='4' tolerance='1e-12'", 1},
        Case{"trapezoidalScheme='true'", 2}}) {
    const double coarse = dampedError(8000, attributes), fine = dampedError(16000, attributes);
    const double extrapolated = (std::exp2(order) * fine - coarse) / (std::exp2(order) - 1);
    std::printf("implicit [%s]: error %.2e of 0.1, order %.3f, extrapolated error %.1e\n",
                attributes.c_str(), fine, std::log2(coarse / fine), extrapolated);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.05);
    EXPECT_LT(std::abs(extrapolated), 2e-6);
  }
}

TEST(EulerImplicit, oneStepIsSofasFormula) {
  const double h = 0.02, rM = 1.5, rK = 0.01, k = 200, m = 0.5, x = 0.1;
  Loaded s = load(oscillator(h, "rayleighMass='1.5' rayleighStiffness='0.01'"));
  s.system().v()[0].x() = 0.7;
  s.run(1);
  const double dv =
      h * (-k * x - (h + rK) * k * 0.7 - rM * m * 0.7) / (m * (1 + h * rM) + h * (h + rK) * k);
  EXPECT_NEAR(s.system().v()[0].x(), 0.7 + dv, 1e-14);
  EXPECT_NEAR(s.system().x()[0].x(), x + h * (0.7 + dv), 1e-14);
}

TEST(EulerImplicit, newtonOnALinearForceIsTheLinearSolve) {
  const std::string damped = "rayleighMass='1.5' rayleighStiffness='0.01' ";
  Loaded one = load(oscillator(0.02, damped));
  Loaded many = load(oscillator(0.02, damped + "newtonIterations='10' tolerance='1e-12'"));
  one.run(50);
  many.run(50);
  EXPECT_NEAR(one.system().x()[0].x(), many.system().x()[0].x(), 1e-14);
  EXPECT_EQ(limiter(many.find<EulerImplicitSolver>(), "notConverged"), 0u);
}

std::string hangingChain(const std::string& solver, const std::string& extra, double dt) {
  return dtNode(dt,
                solver + "<MechanicalObject position='" + line(12, 0.1) +
                    "'/><UniformMass vertexMass='0.02'/><Chain k='3000'/>" + extra,
                "0 -9.81 0");
}

TEST(EulerImplicit, newtonSolvesTheImplicitEulerEquation) {
  const double h = 0.02;
  Loaded s =
      load(hangingChain("<EulerImplicitSolver newtonIterations='60' tolerance='1e-10' "
                        "rayleighMass='0.5'/><SparseLDLSolver keepIterations='0'/>",
                        "<FixedProjectiveConstraint indices='0'/>", h));
  auto& solver = s.find<EulerImplicitSolver>();
  System& system = s.system();
  std::vector<Vec3> f(12);
  int most = 0;
  for (int step = 0; step < 60; ++step) {
    const std::vector<Vec3> x0(system.x().begin(), system.x().end());
    const std::vector<Vec3> v0(system.v().begin(), system.v().end());
    ASSERT_TRUE(s.scene->step());
    most = std::max(most, solver.lastNewtonIterations.value());
    system.computeForce({system.x(), system.v(), s.scene->time()}, f);
    double worst = 0, scale = 0;
    for (std::size_t i = 1; i < 12; ++i) {
      const Vec3 v = system.v()[i];
      EXPECT_LT((system.x()[i] - x0[i] - h * v).norm(), 1e-15);
      worst = std::max(worst, (0.02 * (v - v0[i]) / h + 0.01 * v - f[i]).norm());
      scale = std::max(scale, 0.02 * 9.81);
    }
    EXPECT_LT(worst, 1e-6 * scale) << "step " << step;
  }
  std::printf("at most %d Newton iterations a step, %d factorisations\n", most,
              s.find<SparseLDLSolver>().factorizations.value());
  EXPECT_EQ(limiter(solver, "notConverged"), 0u);
}

TEST(EulerImplicit, energyNeverRises) {
  for (const std::string attributes : {"newtonIterations='80' tolerance='1e-9'",
                                       "newtonIterations='80' tolerance='1e-9' "
                                       "rayleighStiffness='0.01'"}) {
    Loaded s = load(hangingChain("<EulerImplicitSolver " + attributes + "/><SparseLDLSolver/>",
                                 "<FixedProjectiveConstraint indices='0'/>"
                                 "<UniformVelocityDampingForceField dampingCoefficient='0.01'/>",
                                 0.01));
    System& system = s.system();
    const auto energy = [&] {
      return system.kineticEnergy(system.v()) +
             system.potentialEnergy({system.x(), system.v(), s.scene->time()});
    };
    double last = energy(), rise = 0;
    const double first = last;
    for (int step = 0; step < 300; ++step) {
      ASSERT_TRUE(s.scene->step());
      const double now = energy();
      rise = std::max(rise, now - last);
      last = now;
    }
    std::printf("energy %.4f -> %.4f J, largest rise %.1e J\n", first, last, rise);
    EXPECT_LT(rise, 1e-7);
    EXPECT_LT(last, first - 0.01);
  }
}

TEST(EulerImplicit, momentumIsKept) {
  for (const std::string solver :
       {"<EulerImplicitSolver/><SparseLDLSolver tolerance='1e-13'/>",
        "<EulerImplicitSolver newtonIterations='20' tolerance='1e-12'/><SparseLDLSolver "
        "tolerance='1e-13'/>",
        "<EulerImplicitSolver/><CGLinearSolver tolerance='1e-13' iterations='500'/>"}) {
    Loaded s = load(dtNode(0.01, solver + "<MechanicalObject position='" + line(12, 0.1) +
                                     "' velocity='1 2 3'/><UniformMass vertexMass='0.02'/>"
                                     "<Chain k='300'/>"));
    s.system().v()[0] = Vec3(-5, 3, 0);  // a kick that deforms the chain
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (const Vec3& v : s.system().v()) sum += 0.02 * v;
      return sum;
    };
    const Vec3 before = momentum();
    s.run(200);
    const double change = (momentum() - before).norm() / before.norm();
    std::printf("relative change of momentum in 200 steps: %.1e\n", change);
    EXPECT_LT(change, 1e-11);
  }
}

TEST(EulerImplicit, vdampingScalesVelocities) {
  Loaded s = load(dtNode(0.1, "<EulerImplicitSolver vdamping='2'/>" + tightCg +
                                  "<MechanicalObject position='0 0 0' velocity='1 0 0'/>"
                                  "<UniformMass totalMass='1'/>"));
  s.run(5);
  EXPECT_NEAR(s.system().v()[0].x(), std::exp(-1), 1e-14);
}

TEST(EulerImplicit, unconvergedStepsAreCounted) {
  Loaded s =
      load(hangingChain("<EulerImplicitSolver newtonIterations='2' tolerance='1e-14'/>"
                        "<SparseLDLSolver/>",
                        "<FixedProjectiveConstraint indices='0'/>", 0.05));
  s.run(5);
  EXPECT_GT(limiter(s.find<EulerImplicitSolver>(), "notConverged"), 0u);
}

TEST(EulerImplicit, missingLinearSolverAndMassAreErrors) {
  const Loaded noSolver = tryLoad(dtNode(
      0.1,
      "<EulerImplicitSolver/><MechanicalObject position='0 0 0'/><UniformMass totalMass='1'/>"));
  EXPECT_FALSE(noSolver.ready);
  EXPECT_NE(noSolver.text().find("linearSolver"), std::string::npos) << noSolver.text();
  const Loaded noMass = tryLoad(
      dtNode(0.1, "<EulerImplicitSolver/><CGLinearSolver/><MechanicalObject position='0 0 0'/>"));
  EXPECT_FALSE(noMass.ready);
  EXPECT_NE(noMass.text().find("mass-zero"), std::string::npos) << noMass.text();
}

// Two particles on a spring, one of them held, drawn out so far that the spring has stiffened a
// hundredfold: a linear step from there overshoots by far.
std::string overdrawn(const std::string& attributes) {
  return dtNode(0.05, "<EulerImplicitSolver " + attributes + "/>" + tightCg +
                          "<MechanicalObject position='0 0 0  -3 0 0' rest_position='0 0 0  1 0 "
                          "0'/><UniformMass vertexMass='0.01'/><Chain k='300'/>"
                          "<FixedProjectiveConstraint indices='0'/>");
}

TEST(EulerImplicit, aLinearStepThatWouldAddEnergyIsShortened) {
  for (const double careful : {0.1, 1e9}) {
    Loaded s = load(overdrawn("carefulMove='" + std::to_string(careful) + "'"));
    System& system = s.system();
    system.x()[1] = {1e-3, 1e-4, 0};  // pressed together: the way out is not the tangent's
    system.v()[1] = {40, 0, 0};
    const auto energy = [&] {
      return system.kineticEnergy(system.v()) +
             system.potentialEnergy({system.x(), system.v(), s.scene->time()});
    };
    double least = energy(), rise = 0;
    for (int step = 0; step < 100; ++step) {
      ASSERT_TRUE(s.scene->step());
      rise = std::max(rise, (energy() - least) / least);
      least = std::min(least, energy());
    }
    std::printf(
        "careful %g: energy rises by %.2e of the least, %llu steps shortened\n", careful, rise,
        static_cast<unsigned long long>(limiter(s.find<EulerImplicitSolver>(), "shortened")));
    if (careful < 1) {
      EXPECT_LT(rise, 1e-2);
      EXPECT_GT(limiter(s.find<EulerImplicitSolver>(), "shortened"), 0u);
    } else {
      EXPECT_EQ(limiter(s.find<EulerImplicitSolver>(), "shortened"), 0u);
    }
  }
}

TEST(EulerImplicit, ordinaryStepsAreNotShortened) {
  Loaded s = load(hangingChain("<EulerImplicitSolver/>" + tightCg,
                               "<FixedProjectiveConstraint indices='0'/>", 1e-3));
  s.run(300);
  EXPECT_EQ(limiter(s.find<EulerImplicitSolver>(), "shortened"), 0u);
}

}  // namespace
}  // namespace stroma::test
