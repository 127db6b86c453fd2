// SPDX-License-Identifier: Apache-2.0
// Tools on the surface of a body that is cut.
#include "tests/components/collision/collision_scene.h"

namespace stroma::test {
namespace {

const std::string collisionModel = "<BVHCollisionModel name='collision'/>";
// Springs that hold the particles about where they are.
const std::string springs = "<StiffeningSprings k='500'/>";

void expectSameAnswers(const BVHCollisionModel& model, const TriangleTree& rebuilt,
                       std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-0.5, 1.5);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(unit(random), unit(random), unit(random));
    const NearestTriangle a = model.nearest(p, 10);
    const NearestTriangle b = rebuilt.nearest(p, 10, model.triangles(), model.positions());
    EXPECT_EQ(a.triangle, b.triangle);
    EXPECT_EQ(a.at.distance2, b.at.distance2);
  }
}

TEST(CutCollision, treeAnswersLikeOneThatIsBuiltAnew) {
  const Loaded s = loadCollision(squareScene(collisionModel));
  auto& model = s.find<BVHCollisionModel>();
  std::mt19937 random(3);
  std::uint64_t step = 0;
  const auto move = [&] {
    for (Vec3& x : s.system().x()) x += 0.05 * Vec3::Random();
    s.system().updateMapped();
  };
  for (int round = 0; round < 3; ++round) {
    move();
    model.follow(++step);
    cutSquare(*s.scene);
    EXPECT_TRUE(std::ranges::equal(model.triangles(), cutTriangles));
    EXPECT_TRUE(topologyFailures(*s.scene).empty());
    for (int k = 0; k < 3; ++k) {
      // right after the cut, and when the surface has moved on
      TriangleTree rebuilt;
      rebuilt.build(model.triangles(), model.positions());
      ASSERT_EQ(model.positions().size(), 10u);
      EXPECT_EQ(model.positions()[8], model.positions()[3]);
      expectSameAnswers(model, rebuilt, random);
      move();
      model.follow(++step);
    }
    s.scene->reset();
    EXPECT_EQ(model.triangles().size(), 2u);
    EXPECT_EQ(model.positions().size(), 4u);
    TriangleTree rebuilt;
    rebuilt.build(model.triangles(), model.positions());
    expectSameAnswers(model, rebuilt, random);
  }
}

// Before anything has followed again: a blade asks where it touches first.
TEST(CutCollision, aRestoredTreeIsRoundTheRestoredPositions) {
  const Loaded s = loadCollision(squareScene(collisionModel));
  auto& model = s.find<BVHCollisionModel>();
  std::mt19937 random(4);
  model.follow(1);
  const Snapshot start = s.scene->save();
  for (Vec3& x : s.system().x()) x += Vec3(30, 0, 10);
  s.system().updateMapped();
  model.follow(2);
  model.follow(3);  // what was swept on the way is forgotten
  ASSERT_TRUE(s.scene->restore(start));
  TriangleTree rebuilt;
  rebuilt.build(model.triangles(), model.positions());
  expectSameAnswers(model, rebuilt, random);
}

TEST(CutCollision, aBodyStaysClosedOnlyWhileTheSeamIs) {
  // a tetrahedron; its front side is split, and is then separated along the split without walls
  const std::string solid =
      "<EulerImplicitSolver/><CGLinearSolver/><MechanicalObject name='particles' position='0 0 0  "
      "1 "
      "0 0  0 1 0  0 0 1'/><UniformMass vertexMass='1'/><Node name='surface'><MeshTopology "
      "name='mesh' position='0 0 0  1 0 0  0 1 0  0 0 1' triangles='0 2 1  0 1 3  1 2 3  0 3 2'/>"
      "<MechanicalObject name='nodes'/><Riding/>" +
      collisionModel + "</Node>";
  const Loaded s = loadCollision(solid);
  auto& model = s.find<BVHCollisionModel>();
  EXPECT_TRUE(model.closed());
  SurfaceEdit split;
  split.firstNewNode = 4;
  split.firstNewTriangle = 4;
  split.nodes = {{{0.5, 0, 0}, -1, {0, 1}, 0.5}};
  split.changed = {{0, {0, 2, 4}}, {1, {0, 4, 3}}};
  split.appended = {{{4, 2, 1}, 0, false}, {{4, 1, 3}, 1, false}};
  cutSquare(*s.scene, split);
  EXPECT_TRUE(model.closed());
  SurfaceEdit open;
  open.firstNewNode = 5;
  open.firstNewTriangle = 6;
  open.nodes = {{{0.5, 0, 0}, 4, {-1, -1}, 0}};
  open.changed = {{4, {5, 2, 1}}};
  cutSquare(*s.scene, open);
  EXPECT_FALSE(model.closed());
  EXPECT_TRUE(topologyFailures(*s.scene).empty());
  s.scene->reset();
  EXPECT_TRUE(model.closed());
}

// A needle has gone in where the cut comes to pass: what it remembers stays valid.
TEST(CutCollision, aToolInsideStaysInContactThroughACut) {
  for (const Vec3& at : {Vec3(0.2, 0.1, 0), Vec3(0.8, 0.3, 0), Vec3(0.5, 0.9, 0)}) {
    const std::string x = std::to_string(at.x()) + " " + std::to_string(at.y());
    const Loaded s = loadCollision(
        hand("0 5", x + " 0.05 " + x + " -0.05") +
        "<ScalpelTool name='probe' device='@hand' length='1' sampleCount='1'/>" +
        squareScene(collisionModel +
                        "<PenaltyContactForceField name='contact' tools='@/probe' stiffness='70' "
                        "friction='0.2' response='constraint'/>",
                    springs));
    const auto& tool = s.find<RigidTool>();
    s.run(20);
    ASSERT_EQ(tool.contactCount, 1);
    const Vec3 force = tool.totalForce();
    cutSquare(*s.scene);
    s.run(1);
    EXPECT_EQ(tool.contactCount, 1);
    EXPECT_GT(tool.totalForce().dot(force), 0);
    s.run(50);
    s.scene->reset();
    s.run(20);
    EXPECT_EQ(tool.totalForce(), force) << "as if nothing had been cut";
  }
}

TEST(CutGrip, copiesAreHeldAtTheSamePlaceAndNothingIsPulled) {
  const Loaded s = loadCollision(
      hand("0 10 30", "0 1 0  0 1 0  0 1 0.1", "buttons='0 1 1'") +
      "<GripTool name='forceps' device='@hand' radius='0.3'/>" +
      squareScene("<GripContact name='grip' tool='@/forceps' stiffness='90'/>", springs));
  auto& grip = s.find<GripContact>();
  s.run(40);
  ASSERT_EQ(grip.nodeCount, 1);
  const double time = s.scene->time();
  const Vec3 force = totalOn(grip, time);
  const double energy = grip.potentialEnergy(grip.state().view(time));
  cutSquare(*s.scene);
  EXPECT_EQ(grip.nodeCount, 2);
  EXPECT_NEAR((totalOn(grip, time) - force).norm(), 0, 1e-15);
  EXPECT_NEAR(grip.potentialEnergy(grip.state().view(time)), energy, 1e-16);
  s.run(5);
  EXPECT_EQ(grip.nodeCount, 2);
  s.scene->reset();
  EXPECT_EQ(grip.nodeCount, 0);
  s.run(40);
  EXPECT_EQ(totalOn(grip, time), force);
}

}  // namespace
}  // namespace stroma::test
