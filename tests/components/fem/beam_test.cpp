// SPDX-License-Identifier: Apache-2.0
// Whole scenes: beams against published figures, and every solver against every other.
#include <cmath>
#include <stdexcept>

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/stress_field.h"
#include "tests/components/fem/beam_scene.h"

namespace stroma::test {
namespace {

const std::string statics =
    "<StaticSolver name=\"solver\" tolerance=\"1e-8\"/><SparseLDLSolver name=\"linear\"/>";

struct Grid {
  const char* points;
  double hexahedra, tetrahedra;  // SOFA's static deflections, mm
};
// SOFA v26.06 line; its tetrahedra are of another split than ours
constexpr Grid grids[] = {
    {"9 3 3", 33.81, 18.54}, {"17 5 5", 37.73, 29.55}, {"33 9 9", 39.06, 36.23}};
constexpr double limit = 39.66;  // extrapolated from SOFA's hexahedra, mm

double deflection(const std::string& forceField, const Grid& grid, const char* split = "six") {
  return -1000 * tipAfter({statics, forceField, grid.points, split}, 1);
}

TEST(Beam, hexahedraBendAsSofasDo) {
  for (const Grid& grid : grids) {
    const double mm = deflection(hexahedra, grid);
    std::printf("hexahedra %s: %.3f mm, SOFA %.2f (%+.3f %%)\n", grid.points, mm, grid.hexahedra,
                100 * (mm / grid.hexahedra - 1));
    EXPECT_NEAR(mm / grid.hexahedra, 1, 0.001);
  }
}

TEST(Beam, tetrahedraComeCloserToTheLimitAtSecondOrder) {
  for (const char* split : {"six", "five"}) {
    double last = 0;
    for (const Grid& grid : grids) {
      const double mm = deflection(tetrahedra, grid, split);
      std::printf("%s tetrahedra %s: %.3f mm, %.1f %% short of the limit; SOFA %.2f (%+.1f %%)\n",
                  split, grid.points, mm, 100 * (1 - mm / limit), grid.tetrahedra,
                  100 * (mm / grid.tetrahedra - 1));
      // at two layers the split decides: 20.2 mm with six, 26.4 with five
      if (split[0] == 's' && grid.points[0] != '9') {
        EXPECT_NEAR(mm / grid.tetrahedra, 1, 0.05);
      }
      // errors this large do not yet fall by four
      if (last > 0) {
        EXPECT_LT(limit - mm, last / 2);
      }
      EXPECT_LT(mm, limit);
      last = limit - mm;
    }
  }
}

TEST(Beam, everySolverFindsTheSameRest) {
  const std::string ldl = "<SparseLDLSolver name=\"linear\"/>",
                    cg =
                        "<CGLinearSolver name=\"linear\" iterations=\"1000\" tolerance=\"1e-10\"/>",
                    newton = "<StaticSolver name=\"solver\" tolerance=\"1e-8\"/>",
                    implicit = "<EulerImplicitSolver name=\"solver\" rayleighMass=\"2\"/>",
                    explicitly = "<EulerExplicitSolver name=\"solver\" rayleighMass=\"4\"/>";
  for (const std::string& forceField : {tetrahedra, hexahedra, springs}) {
    const bool soft = forceField == springs;
    const std::string gravity = soft ? "0 0 -0.02" : "0 0 -0.1";
    const double rest = tipAfter({newton + ldl, forceField, "9 3 3", "six", gravity}, 1);
    const std::pair<double, const char*> others[] = {
        {tipAfter({newton + cg, forceField, "9 3 3", "six", gravity}, 1), "static, CG"},
        {tipAfter({implicit + ldl, forceField, "9 3 3", "six", gravity, "0.05"}, 400),
         "implicit, LDL"},
        {tipAfter({implicit + cg, forceField, "9 3 3", "six", gravity, "0.05"}, 400),
         "implicit, CG"},
        {tipAfter({explicitly, forceField, "9 3 3", "six", gravity, "0.01"}, 1000), "explicit"}};
    for (const auto& [tip, name] : others) {
      std::printf("%s: %.6f mm, %s: %.6f\n", forceField.substr(1, 10).c_str(), 1000 * rest, name,
                  1000 * tip);
      EXPECT_NEAR(tip / rest, 1, 1e-4) << name;
    }
  }
}

// Hidden modules: a component of the scene is seen through its interfaces only.
Component& find(Scene& scene, const std::string& name) {
  for (Component* c : collect<Component>(scene.root()))
    if (c->name() == name) return *c;
  throw std::runtime_error("no " + name);
}

TEST(Beam, stressIsThatOfBeamTheory) {
  std::string watched = hexahedra;
  watched.insert(watched.find("/>"), " computeVonMisesStress=\"true\"");
  const auto scene = load({statics, watched, "33 9 9"});
  ASSERT_TRUE(scene->step());
  auto& field = find(*scene, "fem");
  auto& state = dynamic_cast<MechanicalState&>(find(*scene, "state"));
  const auto* vonMises =
      dynamic_cast<const Attribute<std::vector<double>>*>(field.attribute("vonMises"));
  ASSERT_TRUE(vonMises);
  // the middle of the under side, a quarter along: its elements' middles are half a cell inside
  const Index node = 8 + 33 * (4 + 9 * 0);
  const double load = 1000 * 0.1 * 0.01, inertia = 0.1 * 0.001 / 12, h = 0.0125;
  const double moment = load * (std::pow(0.3 + h, 3) - std::pow(0.3 - h, 3)) / (12 * h);
  const double expected = -moment * (0.05 - h / 2) / inertia;
  const Mat3 stress =
      dynamic_cast<const StressField&>(field).stressAt(state.view(scene->time()), node);
  std::printf("axial stress %.1f Pa, beam theory %.1f; von Mises %.1f\n", stress(0, 0), expected,
              (**vonMises)[node]);
  EXPECT_NEAR(stress(0, 0) / expected, 1, 0.05);
  const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
  EXPECT_NEAR((**vonMises)[node], std::sqrt(1.5) * deviator.norm(), 1e-9);
}

TEST(Beam, anotherStiffnessAtRunTimeIsFollowed) {
  const std::string linear =
      "<HexahedronFEMForceField name=\"fem\" youngModulus=\"10000\" method=\"small\"/>";
  const auto scene = load({statics, linear, "9 3 3"});
  ASSERT_TRUE(scene->step());
  const double before = tipOf(*scene);
  EXPECT_FALSE(scene->setAttribute("/beam/fem.youngModulus", "25 kPa"));
  ASSERT_TRUE(scene->step());
  EXPECT_NEAR(before / tipOf(*scene), 2.5, 1e-5);
}

}  // namespace
}  // namespace stroma::test
