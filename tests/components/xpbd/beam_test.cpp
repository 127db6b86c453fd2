// SPDX-License-Identifier: Apache-2.0
// Beams of XPBDTetrahedronConstraint against the minimum of the same energy.
#include "tests/components/fem/beam_scene.h"

#include <chrono>
#include <cmath>

#include "core/interfaces/mechanical_state.h"

namespace stroma::test {
namespace {

const std::string statics =
    "<StaticSolver name=\"solver\" tolerance=\"1e-8\"/><SparseLDLSolver name=\"linear\"/>";

std::string solver(int substeps, const std::string& rayleighMass = "4") {
  return "<XPBDSolver name=\"solver\" rayleighMass=\"" + rayleighMass + "\" substeps=\"" +
         std::to_string(substeps) + "\"/>";
}
std::string moduli(const std::string& young) {
  return " youngModulus=\"" + young + "\" poissonRatio=\"0.33\"/>";
}
std::string constraints(const std::string& young) {
  return "<XPBDTetrahedronConstraint name=\"elasticity\"" + moduli(young);
}
std::string elements(const std::string& young) {
  return "<TetrahedronHyperelasticityFEMForceField materialName=\"StableNeoHookean\"" +
         moduli(young);
}

ConstVec3Span positions(Scene& scene) {
  return collect<MechanicalState>(scene.root()).front()->x();
}

TEST(XpbdBeam, comesToRestWhereTheEnergyIsLeast) {
  const std::string push =
      "<ConstantForceField indices=\"@tip.indices\" totalForce=\"0.2 0.3 0\"/>";
  const std::string gravity = "0 0 -0.7";
  const auto exact = load({statics, elements("10000") + push, "9 3 3", "five", gravity});
  ASSERT_TRUE(exact->step());
  double last = 0;
  for (const int substeps : {4, 8, 16, 32}) {
    const auto scene =
        load({solver(substeps), constraints("10000") + push, "9 3 3", "five", gravity, "0.02"});
    for (int k = 0; k < 600; ++k) ASSERT_TRUE(scene->step());
    double most = 0;
    for (std::size_t i = 0; i < positions(*exact).size(); ++i)
      most = std::max(most, (positions(*scene)[i] - positions(*exact)[i]).norm());
    const double error = most / std::abs(tipOf(*exact));
    std::printf(
        "%5.2f ms: end at %.6f mm, least energy %.6f; particles off by at most %.1e of it\n",
        20.0 / substeps, 1000 * tipOf(*scene), 1000 * tipOf(*exact), error);
    if (last > 0) {
      EXPECT_LT(error, last / 3) << substeps;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(XpbdBeam, isTooSoftWhileTheSubstepsAreTooFew) {
  struct Case {
    int substeps;
    double low, high;  // bars of the deflection over that of least energy
  };
  struct Solid {
    const char *young, *rayleighMass;
    int steps;  // until it rests
    std::vector<Case> cases;
  };
  const Solid solids[] = {
      {"10000", "4", 700, {{5, 0.999, 1.001}}},
      {"1e6", "30", 140, {{5, 1.2, 2}, {20, 1.005, 1.02}, {50, 1, 1.002}}},
  };
  for (const Solid& solid : solids) {
    const Beam rest{statics, elements(solid.young), "21 6 6", "six", "0 0 -9.81"};
    const double least = tipAfter(rest, 1);
    for (const Case& c : solid.cases) {
      const auto scene = load({solver(c.substeps, solid.rayleighMass), constraints(solid.young),
                               rest.points, rest.split, rest.gravity, "0.005"});
      const auto begin = std::chrono::steady_clock::now();
      for (int k = 0; k < solid.steps; ++k) ASSERT_TRUE(scene->step());
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      const double ratio = tipOf(*scene) / least;
      std::printf(
          "756 nodes, E %s Pa, 5 ms in %d: end at %.4f m, least energy %.4f (%.4f); %.2f ms a "
          "step\n",
          solid.young, c.substeps, tipOf(*scene), least, ratio, 1000 * time.count() / solid.steps);
      EXPECT_GT(ratio, c.low);
      EXPECT_LT(ratio, c.high);
    }
  }
}

// Far too stiff for its sub-steps it shakes, but does not blow up.
TEST(XpbdBeam, staysBoundedAtAnyStiffness) {
  for (const char* young : {"1e8", "1e10"}) {
    const auto scene = load({solver(2), constraints(young), "9 3 3", "six", "0 0 -9.81", "0.01"});
    double most = 0;
    for (int k = 0; k < 200; ++k) {
      ASSERT_TRUE(scene->step());
      for (const Vec3& x : positions(*scene)) most = std::max(most, x.norm());
    }
    std::printf("E %s Pa: no particle further than %.2f m\n", young, most);
    EXPECT_LT(most, 5);
  }
}

}  // namespace
}  // namespace stroma::test
