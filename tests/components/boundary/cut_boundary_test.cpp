// SPDX-License-Identifier: Apache-2.0
// Loads and supports on the surface of a body that is cut.
#include "components/topology/mesh_topology.h"
#include "tests/components/boundary/boundary_scene.h"
#include "tests/components/topology/hand_made_cut.h"

namespace stroma::test {
namespace {

Loaded square(const std::string& content) {
  SceneOptions options;
  options.pluginFolders.clear();
  Loaded loaded{std::make_unique<Scene>(options), false};
  Registry& registry = loaded.scene->registry();
  registerAll(registry);
  registry.add<MeshTopology>("MeshTopology");
  registry.add<Riding>("Riding");
  registry.add<SurfacePressureForceField>("SurfacePressureForceField");
  registry.add<TractionForceField>("TractionForceField");
  registry.add<GripForceField>("GripForceField");
  loaded.ready = loaded.scene->loadText(dtNode(0.01, squareScene(content)), "test.xml") &&
                 loaded.scene->initialise();
  EXPECT_TRUE(loaded.ready) << loaded.text();
  // somewhere else than at rest
  for (std::size_t i = 0; i < 4; ++i) {
    const auto t = static_cast<double>(i);
    loaded.system().x()[i] += 0.1 * Vec3(std::sin(3 * t + 1), std::cos(5 * t), std::sin(7 * t + 2));
  }
  loaded.system().updateMapped();
  return loaded;
}

std::vector<Vec3> forces(ForceField& field) {
  std::vector<Vec3> f(static_cast<std::size_t>(field.state().size()), Vec3::Zero());
  field.addForce(field.state().view(0), f);
  return f;
}

Vec3 sum(const std::vector<Vec3>& f) {
  Vec3 total = Vec3::Zero();
  for (const Vec3& one : f) total += one;
  return total;
}

double energy(ForceField& field) { return field.potentialEnergy(field.state().view(0)); }

// All of them keep total force and energy, and are as before when the body is whole again.
class LoadsOnACutBody : public testing::TestWithParam<const char*> {};

TEST_P(LoadsOnACutBody, areTheSameInTotalAfterACutAndBeforeOne) {
  const Loaded s = square(GetParam());
  ForceField& field = s.find<ForceField>();
  const std::vector<Vec3> before = forces(field);
  const double energyBefore = energy(field);
  cutSquare(*s.scene);
  const std::vector<Vec3> after = forces(field);
  ASSERT_EQ(after.size(), 10u);
  const double difference = (sum(after) - sum(before)).norm() / sum(before).norm();
  const double gained = std::abs(energy(field) - energyBefore) / std::abs(energyBefore);
  std::printf("total force differs by %.1e, energy by %.1e\n", difference, gained);
  EXPECT_LT(difference, 1e-14);
  EXPECT_LT(gained, 1e-14);
  EXPECT_EQ(after[9], Vec3::Zero()) << "the wall carries nothing";
  EXPECT_TRUE(topologyFailures(*s.scene).empty());

  const std::vector<Vec3> x(s.system().x().begin(), s.system().x().end());
  s.scene->reset();
  std::ranges::copy(x, s.system().x().begin());
  s.system().updateMapped();
  if (!dynamic_cast<GripForceField*>(&field)) {  // its grip has closed anew
    EXPECT_EQ(forces(field), before);
    EXPECT_EQ(energy(field), energyBefore);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LoadsOnACutBody,
    testing::Values("<SurfacePressureForceField pressure='3'/>",
                    "<SurfacePressureForceField pressure='3' triangles='0 2 3'/>",
                    "<TractionForceField traction='1 2 3'/>",
                    "<TractionForceField stress='5 3 -2 1 4 2' triangleIndices='0'/>",
                    "<ConstantForceField indices='0 3' forces='1 2 3 4 5 6'/>",
                    "<ConstantForceField totalForce='1 2 3'/>",
                    "<RestShapeSpringsForceField points='1 3' stiffness='5 7'/>",
                    "<GripForceField indices='0 3' stiffness='9' keyTimes='0' "
                    "displacements='0 0 1'/>"));

TEST(CutLoads, piecesOfLoadedTrianglesAreLoadedAndWallsAreNot) {
  const Loaded s = square("<SurfacePressureForceField pressure='6' triangleIndices='1'/>");
  s.scene->reset();
  cutSquare(*s.scene);
  const std::vector<Vec3> f = forces(s.find<SurfacePressureForceField>());
  // slot 1 (0 4 3) of area 1/6 and slot 4 (6 2 8) of area 1/3: a third of 6 Pa times the area each
  const double small = 2.0 / 6, large = 2.0 / 3;
  const std::vector<double> expected{small, 0, large, small, small, 0, large, 0, large, 0};
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_NEAR((f[i] - Vec3(0, 0, expected[i])).norm(), 0, 1e-15) << "node " << i;
  }
}

TEST(CutLoads, derivativeOfThePressureHasTheNewNodes) {
  const Loaded s = square("<SurfacePressureForceField pressure='6'/>");
  cutSquare(*s.scene);
  auto& field = s.find<SurfacePressureForceField>();
  const StateView at = field.state().view(0);
  field.linearize(at);
  BlockPattern pattern(10);
  ASSERT_TRUE(field.addPattern(pattern, 0));
  BlockMatrix blocks(std::move(pattern));
  field.addTangent(blocks, 0, 1, 0);
  const Eigen::MatrixXd lower = blocks.lower();
  const Eigen::MatrixXd assembled = lower.selfadjointView<Eigen::Lower>();
  double worst = 0;
  for (Eigen::Index c = 0; c < 30; ++c) {
    std::vector<Vec3> dx(10, Vec3::Zero()), df(10, Vec3::Zero());
    flat(Vec3Span(dx))[c] = 1;
    field.addTangentProduct(dx, 1, 0, df);
    worst = std::max(worst, (flat(Vec3Span(df)) - assembled.col(c)).norm());
  }
  EXPECT_GT(assembled.col(3 * 7).norm(), 1) << "node 7 moves the force";
  EXPECT_LT(worst, 1e-14);
}

TEST(CutLoads, trianglesThatAreNotTheTopologysAreNamed) {
  const Loaded s = square("<SurfacePressureForceField pressure='6' triangles='1 2 0'/>");
  cutSquare(*s.scene);
  EXPECT_NE(s.text().find("[triangles-uncut]"), std::string::npos) << s.text();
  EXPECT_EQ(forces(s.find<SurfacePressureForceField>())[4], Vec3::Zero());
}

TEST(CutSupports, separatedNodesShare) {
  const Loaded s = square(
      "<GripForceField name='grip' indices='0 3' stiffness='8' keyTimes='0' "
      "displacements='0 0 1'/>");
  const std::vector<Vec3> before = forces(s.find<GripForceField>());
  cutSquare(*s.scene);
  const std::vector<Vec3> after = forces(s.find<GripForceField>());
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[3], 0.5 * before[3]);
  EXPECT_EQ(after[8], 0.5 * before[3]);
  EXPECT_EQ(after[4], Vec3::Zero());
  // a second separation of one of the two
  SurfaceEdit more;
  more.firstNewNode = 10;
  more.firstNewTriangle = 7;
  more.nodes = {{{0, 1, 0}, 8, {-1, -1}, 0}};
  cutSquare(*s.scene, more);
  EXPECT_EQ(forces(s.find<GripForceField>())[8], 0.25 * before[3]);
  EXPECT_EQ(forces(s.find<GripForceField>())[10], 0.25 * before[3]);
}

TEST(CutSupports, aNewValueReachesTheCopies) {
  const Loaded s = square("<ConstantForceField name='load' totalForce='0 0 8'/>");
  cutSquare(*s.scene);
  EXPECT_FALSE(s.scene->setAttribute("/surface/load.totalForce", "0 0 16"));
  const std::vector<Vec3> f = forces(s.find<ConstantForceField>());
  EXPECT_EQ(f[0], Vec3(0, 0, 4));
  EXPECT_EQ(f[3], Vec3(0, 0, 2));
  EXPECT_EQ(f[8], Vec3(0, 0, 2));
}

}  // namespace
}  // namespace stroma::test
