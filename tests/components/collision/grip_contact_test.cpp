// SPDX-License-Identifier: Apache-2.0
#include "tests/components/collision/collision_scene.h"

namespace stroma::test {
namespace {

std::string gripping(const std::string& path) {
  return path + "<GripTool name='forceps' device='@hand' radius='0.16'/>" +
         softSurface(grid(6, 0.15), 10) +
         "<GripContact name='grip' tool='@forceps' stiffness='90'/>";
}

TEST(GripContact, holdsWhatIsNearTheTipAndLetsGo) {
  const Loaded s = loadCollision(gripping(
      hand("0 10 100 200 210", "0 0 0  0 0 0  0 0 0.1  0 0 0.1  0 0 0.1", "buttons='0 1 1 1 0'")));
  const auto& grip = s.find<GripContact>();
  const auto& tool = s.find<GripTool>();
  s.run(9);
  EXPECT_EQ(grip.nodeCount, 0);
  s.run(1);
  EXPECT_EQ(grip.nodeCount, 5) << "the middle node and its four neighbours";
  EXPECT_NEAR(grip.force->norm(), 0, 1e-12) << "closing pulls at nothing";
  s.run(190);
  // two springs in a row, 90 N/m to the grip and 10 N/m to the rest position, for each node
  EXPECT_NEAR(grip.force->z(), 5 * 0.9, 1e-3);
  EXPECT_NEAR(s.system().x()[24].z(), 0.09, 1e-4);
  EXPECT_NEAR((tool.totalForce() + *grip.force).norm(), 0, 1e-12);
  EXPECT_NEAR((*grip.force - totalOn(s.find<GripContact>(), s.scene->time())).norm(), 0, 1e-12);
  s.run(11);
  EXPECT_EQ(grip.nodeCount, 0);
  EXPECT_EQ(tool.totalForce(), Vec3::Zero());
  EXPECT_EQ(s.find<ScriptedDevice>().force->norm(), 0);
}

TEST(GripContact, turnsWithTheTool) {
  const Loaded s =
      loadCollision(gripping(hand("0 10 100 200", "0 0 0  0 0 0  0 0 0  0 0 0",
                                  "buttons='1 1 1 1' rotations='0 0 0  0 0 0  0 0 90  0 0 90'")));
  s.run(200);
  // node 25 is at (0.15, 0, 0); turned by 90 degrees the grip wants it at (0, 0.15, 0)
  EXPECT_NEAR((s.system().x()[25] - Vec3(0.015, 0.135, 0)).norm(), 0, 1e-4);
  EXPECT_NEAR(s.find<GripTool>().totalForce().norm(), 0, 1e-6);
  // four nodes, arm 0.1358, against springs of 10 N/m
  EXPECT_LT(s.find<GripTool>().totalTorque().z(), -0.1);
}

TEST(GripContact, checkpointContinuesWithTheSameBits) {
  const std::string xml = gripping(hand("0 10 50", "0 0 0  0 0 0  0 0.02 0.1", "buttons='0 1 1'"));
  const Loaded a = loadCollision(xml), b = loadCollision(xml);
  a.run(30);
  ASSERT_TRUE(b.scene->restore(a.scene->save()));
  a.run(30);
  b.run(30);
  EXPECT_EQ(a.scene->stateHash(), b.scene->stateHash());
  EXPECT_EQ(b.find<GripContact>().nodeCount, 5);
}

TEST(GripContact, closingOnNothingIsCounted) {
  const Loaded s = loadCollision(gripping(hand("0", "0 0 1", "buttons='1'")));
  s.run(5);
  EXPECT_EQ(limiter(s.find<GripContact>(), "closedOnNothing"), 1u);
}

}  // namespace
}  // namespace stroma::test
