// SPDX-License-Identifier: Apache-2.0
// Laws of the solver in time.
#include <cmath>

#include "core/interfaces/mechanical_state.h"
#include "core/parallel.h"
#include "tests/components/fem/beam_scene.h"

namespace stroma::test {
namespace {

const std::string tetrahedra1MPa =
    "<XPBDTetrahedronConstraint name=\"elasticity\" youngModulus=\"1e6\" poissonRatio=\"0.33\"/>";

std::unique_ptr<Scene> loadText(const std::string& text) {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.writesOutput = false;
  auto scene = std::make_unique<Scene>(options);
  EXPECT_TRUE(scene->loadText(text, "scene.xml") && scene->initialise())
      << scene->diagnostics().text();
  EXPECT_EQ(scene->diagnostics().warningCount(), 0) << scene->diagnostics().text();
  return scene;
}

MechanicalState& stateOf(Scene& scene) { return *collect<MechanicalState>(scene.root()).front(); }

void advance(Scene& scene, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_TRUE(scene.step());
}

// 1 kg on a spring of 100 N/m and 1 m, which its weight begins to stretch.
double hangingMass(int substeps, const std::string& damping) {
  const auto scene = loadText(
      "<Node name=\"root\" dt=\"0.01\" gravity=\"0 0 -9.81\"><XPBDSolver name=\"solver\" "
      "substeps=\"" +
      std::to_string(substeps) +
      "\"/><MeshTopology name=\"mesh\" position=\"0 0 0  0 0 -1\" edges=\"0 1\"/>"
      "<MechanicalObject name=\"state\"/><UniformMass vertexMass=\"1\"/>"
      "<XPBDDistanceConstraint stiffness=\"100\" damping=\"" +
      damping + "\"/><FixedProjectiveConstraint indices=\"0\"/></Node>");
  advance(*scene, 37);
  EXPECT_EQ(stateOf(*scene).x()[0], Vec3::Zero());
  return -1 - stateOf(*scene).x()[1][2];
}

TEST(XpbdSolver, aMassOnAConstraintMovesAsTheOscillatorAtFirstOrder) {
  for (const double damping : {0.0, 0.03}) {
    // x'' + 100 damping x' + 100 x = 9.81
    const double decay = 50 * damping, w = std::sqrt(100 - decay * decay), t = 0.37;
    const double exact =
        0.0981 * (1 - std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t)));
    double last = 0;
    for (const int substeps : {8, 16, 32, 64}) {
      const double error = std::abs(hangingMass(substeps, std::to_string(damping)) - exact);
      std::printf("damping %.2f s, %2d sub-steps: error %.2e m\n", damping, substeps, error);
      if (last > 0) {
        EXPECT_NEAR(std::log2(last / error), 1, 0.05);
      }
      last = error;
    }
  }
}

TEST(XpbdSolver, aBodyAtRestStaysAtRest) {
  const auto scene = load({"<XPBDSolver name=\"solver\" substeps=\"20\"/>", tetrahedra1MPa, "9 3 3",
                           "six", "0 0 0", "0.005"});
  advance(*scene, 200);
  const MechanicalState& state = stateOf(*scene);
  double moved = 0;
  for (std::size_t i = 0; i < state.x().size(); ++i)
    moved = std::max(moved, (state.x()[i] - state.rest()[i]).norm());
  std::printf("after 4000 sub-steps: %.1e m\n", moved);
  EXPECT_LT(moved, 1e-15);
}

// A cube that spins freely, 2 rad/s about x and drifting.
std::string spinning(int substeps) {
  std::string velocities;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        velocities += "0.3 " + std::to_string(-0.05 * (z - 1) * 2) + ' ' +
                      std::to_string(0.05 * (y - 1) * 2) + "  ";
  return "<Node name=\"root\" dt=\"0.01\" gravity=\"0 0 0\"><XPBDSolver name=\"solver\" "
         "substeps=\"" +
         std::to_string(substeps) +
         "\"/><RegularGridTopology name=\"grid\" n=\"3 3 3\" min=\"0 0 0\" max=\"0.1 0.1 0.1\" "
         "createTetrahedra=\"six\"/><MechanicalObject name=\"state\" velocity=\"" +
         velocities +
         "\"/><UniformMass totalMass=\"1\"/><XPBDTetrahedronConstraint youngModulus=\"10000\" "
         "poissonRatio=\"0.33\"/></Node>";
}

TEST(XpbdSolver, aFreeBodyKeepsItsMomentum) {
  double last = 0;
  for (const int substeps : {5, 10, 20, 40}) {
    const auto scene = loadText(spinning(substeps));
    const MechanicalState& state = stateOf(*scene);
    const auto momentum = [&](Vec3& p, Vec3& l) {
      p.setZero(), l.setZero();
      for (std::size_t i = 0; i < state.x().size(); ++i) {
        p += state.v()[i] / 27;
        l += state.x()[i].cross(state.v()[i]) / 27;
      }
    };
    Vec3 p0, l0, p, l;
    momentum(p0, l0);
    advance(*scene, 100);
    momentum(p, l);
    const double spin = (l - l0).x() / l0.x();
    std::printf("%2d sub-steps: momentum off by %.1e, angular momentum by %.2e after 1 s\n",
                substeps, (p - p0).norm() / p0.norm(), spin);
    // velocities are differences of rounded positions
    EXPECT_LT((p - p0).norm() / p0.norm(), 1e-11);
    if (last > 0) {
      EXPECT_NEAR(last / std::abs(spin), 2, 0.3);
    }
    last = std::abs(spin);
  }
}

Beam loaded() {
  return {"<XPBDSolver name=\"solver\" substeps=\"4\" iterations=\"2\"/>",
          "<XPBDTetrahedronConstraint name=\"elasticity\" youngModulus=\"20000\" "
          "poissonRatio=\"0.4\" damping=\"1 ms\"/><XPBDDistanceConstraint stiffness=\"0.1\"/>"
          "<XPBDVolumeConstraint stiffness=\"1e4\"/>"
          "<FixedPlaneProjectiveConstraint direction=\"0 1 0\" dmin=\"-0.01\" dmax=\"0.001\"/>",
          "17 9 9",
          "six",
          "0 0 -9.81",
          "0.005"};
}

TEST(XpbdSolver, hasTheSameBitsAtOneAndTwoThreads) {
  std::uint64_t hash[2];
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    const auto scene = load(loaded());
    advance(*scene, 15);
    hash[threads - 1] = scene->stateHash();
    for (std::size_t i = 0; i < 17; ++i) EXPECT_EQ(stateOf(*scene).x()[i][1], 0);
  }
  setThreadCount(1);
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(XpbdSolver, resumesAndStartsAgainWithTheSameBits) {
  const auto straight = load(loaded());
  advance(*straight, 5);
  const std::uint64_t early = straight->stateHash();
  const Snapshot half = straight->save();
  advance(*straight, 5);
  const auto resumed = load(loaded());
  ASSERT_TRUE(resumed->restore(half));
  advance(*resumed, 5);
  EXPECT_EQ(straight->stateHash(), resumed->stateHash());
  straight->reset();
  advance(*straight, 5);
  EXPECT_EQ(straight->stateHash(), early);
}

TEST(XpbdSolver, anotherStiffnessAtRunTimeIsFollowed) {
  const std::string solver = "<XPBDSolver name=\"solver\" substeps=\"40\" rayleighMass=\"20\"/>";
  const auto scene = load({solver, tetrahedra1MPa, "5 2 2", "six", "0 0 -1", "0.01"});
  advance(*scene, 100);
  const double before = tipOf(*scene);
  EXPECT_FALSE(scene->setAttribute("/beam/elasticity.youngModulus", "500 kPa"));
  advance(*scene, 100);
  std::printf("half as stiff: %.4f times as far\n", tipOf(*scene) / before);
  EXPECT_NEAR(tipOf(*scene) / before, 2, 0.01);
}

// |F| and det F both change with the volume alone where a body is at rest: bending is damped less.
TEST(XpbdSolver, dampingSlowsABodyAndDoesNotMoveItsRest) {
  const auto run = [&](const std::string& damping, const std::string& rayleighMass) {
    std::string body = tetrahedra1MPa;
    body.insert(body.find("/>"), " damping=\"" + damping + "\"");
    const auto scene = load(
        {"<XPBDSolver substeps=\"50\" iterations=\"4\" rayleighMass=\"" + rayleighMass + "\"/>",
         body, "5 2 2", "six", "0 0 -1", "0.01"});
    advance(*scene, 200);
    return std::pair(flat(ConstVec3Span(stateOf(*scene).v())).norm(), tipOf(*scene));
  };
  const auto free = run("0", "0"), damped = run("2 ms", "0");
  const auto resting = run("0", "20"), restingDamped = run("2 ms", "20");
  std::printf("speed after 2 s: %.1e m/s, damped %.1e; at rest at %.6f mm, damped %.6f\n",
              free.first, damped.first, 1000 * resting.second, 1000 * restingDamped.second);
  EXPECT_LT(damped.first, 0.5 * free.first);
  EXPECT_NEAR(restingDamped.second / resting.second, 1, 0.01);
}

}  // namespace
}  // namespace stroma::test
