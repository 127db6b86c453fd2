// SPDX-License-Identifier: Apache-2.0
#include "tests/components/boundary/boundary_scene.h"

namespace stroma::test {
namespace {

std::string falling(const std::string& content) {
  return dtNode(0.01,
                "<EulerImplicitSolver/><CGLinearSolver tolerance='1e-12'/><MechanicalObject "
                "position='0.1 0.2 0.3 1 1 1 2 2 2'/><UniformMass vertexMass='1'/>" +
                    content,
                "1 2 3");
}

TEST(Fixed, heldParticlesKeepTheirBits) {
  for (const std::string which : {"indices='0 2'", "fixAll='true'"}) {
    Loaded s = loadBoundary(falling("<FixedProjectiveConstraint " + which + "/>"));
    s.run(20);
    EXPECT_EQ(s.system().x()[0], Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(s.system().x()[2], Vec3(2, 2, 2));
    EXPECT_EQ(s.system().x()[1] == Vec3(1, 1, 1), which[0] == 'f');
  }
}

TEST(PartialFixed, holdsTheChosenAxesOnly) {
  Loaded s = loadBoundary(
      falling("<PartialFixedProjectiveConstraint indices='1' fixedDirections='1 0 1'/>"));
  s.run(20);
  EXPECT_EQ(s.system().x()[1].x(), 1);
  EXPECT_EQ(s.system().x()[1].z(), 1);
  EXPECT_NEAR(s.system().x()[1].y(), s.system().x()[0].y() + 0.8, 1e-12);
}

TEST(FixedPlane, particlesSlideInTheirPlane) {
  Loaded s = loadBoundary(
      falling("<FixedPlaneProjectiveConstraint direction='1 1 0' dmin='1' dmax='2'/>"));
  s.run(20);
  const Vec3 normal = Vec3(1, 1, 0).normalized();
  const Vec3 moved = s.system().x()[1] - Vec3(1, 1, 1);  // at a distance of 1.41
  EXPECT_NEAR(moved.dot(normal), 0, 1e-14);
  EXPECT_GT(moved.z(), 0.01);
  EXPECT_GT(s.system().x()[2].dot(normal), 2.86) << "at 2.83 it is outside and falls freely";
}

std::string gripped(const std::string& attributes) {
  return dtNode(0.01,
                "<EulerImplicitSolver rayleighMass='20'/><CGLinearSolver tolerance='1e-12'/>"
                "<MechanicalObject position='0 0 0 1 0 0'/><UniformMass vertexMass='0.1'/>"
                "<StiffeningSprings k='10'/><GripForceField name='grip' indices='1' stiffness='90' "
                "keyTimes='0 0.5' displacements='0 0 0 0 0.2 0' " +
                    attributes + "/>");
}

TEST(Grip, pullsAlongThePathAndReportsItsForce) {
  for (const double scale : {1.0, -1.0}) {
    Loaded s = loadBoundary(gripped("scale='" + std::to_string(scale) + "'"));
    s.run(200);
    // two springs in a row: 90 N/m to the grip, 10 N/m to the rest position
    EXPECT_NEAR(s.system().x()[1].y(), scale * 0.18, 1e-6);
    const auto& grip = s.find<GripForceField>();
    EXPECT_NEAR(grip.displacement->y(), scale * 0.2, 1e-15);
    EXPECT_NEAR(grip.force->y(), scale * 1.8, 1e-4);
    EXPECT_NEAR(grip.displacementAt(0.25).y(), scale * 0.1, 1e-15);
    EXPECT_EQ(s.system().x()[0], Vec3(0, 0, 0));
  }
}

TEST(Grip, scaleCanBeChangedWhileRunning) {
  Loaded s = loadBoundary(gripped(""));
  s.run(100);
  ASSERT_FALSE(s.scene->setAttribute("/grip.scale", "-1"));
  s.run(200);
  EXPECT_NEAR(s.system().x()[1].y(), -0.18, 1e-6);
}

TEST(Grip, releasesAndGraspsWhenToldTo) {
  Loaded released = loadBoundary(gripped("release='1'"));
  released.run(300);
  EXPECT_NEAR(released.system().x()[1].y(), 0, 1e-6);
  EXPECT_EQ(*released.find<GripForceField>().force, Vec3::Zero());

  // closes at 1 s, when the load has moved the node by 0.3: the path starts from there
  Loaded late = loadBoundary(
      dtNode(0.01,
             "<EulerImplicitSolver rayleighMass='20'/><CGLinearSolver tolerance='1e-12'/>"
             "<MechanicalObject position='0 0 0'/><UniformMass vertexMass='0.1'/>"
             "<StiffeningSprings k='10'/><ConstantForceField totalForce='3 0 0'/>"
             "<GripForceField name='grip' indices='0' stiffness='90' keyTimes='1 2' "
             "displacements='0 0 0 0 0.2 0' grasp='1'/>"));
  late.run(99);
  EXPECT_EQ(*late.find<GripForceField>().force, Vec3::Zero());
  const double at = late.system().x()[0].x();
  EXPECT_NEAR(at, 0.3, 1e-3);
  late.run(3);
  EXPECT_NEAR(late.system().x()[0].x(), at, 1e-3) << "closing pulls at nothing";
  const Snapshot half = late.scene->save();
  late.run(200);
  EXPECT_NEAR(late.system().x()[0].y(), 0.18, 1e-4);
  const std::uint64_t hash = late.scene->stateHash();
  ASSERT_TRUE(late.scene->restore(half));
  late.run(200);
  EXPECT_EQ(hash, late.scene->stateHash());
}

struct Mistake {
  std::string content, expected;
};

TEST(Boundary, mistakesAreNamed) {
  const std::vector<Mistake> mistakes = {
      {"<FixedProjectiveConstraint/>", "does not say which particles it holds"},
      {"<FixedProjectiveConstraint indices='0' fixAll='true'/>", "holds every particle"},
      {"<FixedProjectiveConstraint indices='6'/>", "names particle 6, but '/"},
      {"<PartialFixedProjectiveConstraint indices='0' fixedDirections='1 0'/>", "expected 3"},
      {"<FixedPlaneProjectiveConstraint direction='0 0 0' indices='0'/>", "zero vector"},
      {"<FixedPlaneProjectiveConstraint direction='0 0 1'/>", "either 'dmin' and 'dmax'"},
      {"<FixedPlaneProjectiveConstraint direction='0 0 1' dmin='2' dmax='1'/>", "less than 'dmin'"},
      {"<RestShapeSpringsForceField stiffness='1'/>", "either 'points' or all"},
      {"<RestShapeSpringsForceField points='1'/>", "stiffness"},
      {"<RestShapeSpringsForceField points='1 2 3' stiffness='1 2'/>", "2 values for 3 points"},
      {"<RestShapeSpringsForceField points='1 2 1' stiffness='1'/>", "names particle 1 twice"},
      {"<RestShapeSpringsForceField points='1' stiffness='-1'/>", "out of range"},
      {"<RestShapeSpringsForceField points='1' stiffness='nan'/>", "nan"},
      {"<ConstantForceField/>", "one of 'forces' and 'totalForce'"},
      {"<ConstantForceField indices='0' forces='1 0 0 2 0 0'/>", "2 forces for 1 particles"},
      {"<ConstantForceField indices='9' totalForce='1 0 0'/>", "names particle 9"},
      {"<SurfacePressureForceField/>", "pressure"},
      {"<SurfacePressureForceField pressure='1' triangleIndices='8'/>",
       "names triangle 8, but there are 8"},
      {"<SurfacePressureForceField pressure='1' triangles='0 1 77'/>", "has node 77"},
      {"<TractionForceField/>", "one of 'traction' and 'stress'"},
      {"<TractionForceField stress='1 2 3'/>", "expected 6"},
      {"<TractionForceField stressGradient='1 2 3'/>", "expected 18"},
      {"<TractionForceField traction='1 2 3' stressOrigin='1 2 3'/>", "no meaning without"},
      {"<GripForceField indices='0' stiffness='1' keyTimes='0 1' displacements='0 0 0'/>",
       "1 displacements for 2 key times"},
      {"<GripForceField indices='0' stiffness='1' keyTimes='1 0' displacements='0 0 0 1 1 1'/>",
       "does not rise"},
      {"<GripForceField indices='0' stiffness='0' keyTimes='0' displacements='0 0 0'/>",
       "greater than 0"}};
  for (const auto& [content, expected] : mistakes) {
    const Loaded s = tryBoundary(onOctahedron(content));
    EXPECT_FALSE(s.ready) << content;
    EXPECT_NE(s.text().find(expected), std::string::npos) << content << "\n" << s.text();
  }
}

TEST(Boundary, emptyListIsWarnedOf) {
  const Loaded s = loadBoundary(onOctahedron("<FixedProjectiveConstraint indices=''/>"));
  EXPECT_NE(s.text().find("acts on no particle"), std::string::npos) << s.text();
}

}  // namespace
}  // namespace stroma::test
