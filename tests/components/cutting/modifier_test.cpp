// SPDX-License-Identifier: Apache-2.0
// Blades in a block: when they go in, what they divide, and what they do not.
#include "tests/components/cutting/cut_block.h"

namespace stroma::test {
namespace {

const std::string contact =
    R"(<BVHCollisionModel state="@surface/nodes" topology="@surface/mesh"/>
       <PenaltyContactForceField tools="@/scalpel" stiffness="50 N/m"/>)";

// A scalpel that presses the middle of the top, 3 mm in 30 ms.
BlockOptions pressing(const std::string& cut) {
  return {.tools = scalpel("scalpel", "0 0.03 0.04", "6.3 6.2 8  6.3 6.2 5  6.3 6.2 5"),
          .cut = cut,
          .contact = contact};
}

TEST(Pierce, byForceInTheStepAfterItIsReached) {
  CutBlock body(pressing(R"(pierceCriterion="force" pierceForce="5 mN")"));
  double before = 0;
  while (!body.cut->cutting && body.scene.stepCount() < 40) {
    EXPECT_LT(before, 5e-3);
    before = body.tool().totalForce().norm();
    body.step();
  }
  ASSERT_TRUE(body.cut->cutting);
  std::printf("pierced after %.2f mN, %.0f ms\n", 1e3 * before, 1e3 * body.scene.time());
  EXPECT_GE(before, 5e-3);
  EXPECT_TRUE(body.tool().cutting());
  body.advanceTo(0.035);
  EXPECT_EQ(body.tool().totalForce(), Vec3(Vec3::Zero())) << "it touches nothing while it cuts";
}

TEST(Pierce, byStressInTheStepInWhichItIsReached) {
  CutBlock body(pressing(R"(pierceCriterion="stress" pierceStress="1 kPa")"));
  double highest = 0;
  while (!body.cut->cutting && body.scene.stepCount() < 40) {
    EXPECT_LT(body.cut->tipStress, 1e3);
    body.step();
    highest = std::max(highest, body.cut->tipStress.value());
  }
  std::printf("pierced at %.0f Pa\n", highest);
  EXPECT_TRUE(body.cut->cutting);
  EXPECT_GE(highest, 1e3);
}

// Of a point that presses a spring, work over way squared is half its stiffness at any depth.
TEST(Pierce, byEnergyWhereItTakesLittle) {
  CutBlock body(pressing(R"(pierceCriterion="energy" pierceEnergy="1 J/m^2")"));
  while (!body.cut->cutting && body.scene.stepCount() < 40) body.step();
  std::printf("pierced after %.0f ms\n", 1e3 * body.scene.time());
  EXPECT_TRUE(body.cut->cutting);
  EXPECT_GT(body.scene.stepCount(), 1u) << "not before it touches";
}

TEST(Pierce, notBelowTheThreshold) {
  for (const std::string cut : {R"(pierceCriterion="force" pierceForce="1 N")",
                                R"(pierceCriterion="stress" pierceStress="1 MPa")",
                                R"(pierceCriterion="energy" pierceEnergy="1 kJ/m^2")"}) {
    CutBlock body(pressing(cut));
    body.advanceTo(0.04);
    EXPECT_FALSE(body.cut->cutting) << cut;
    EXPECT_FALSE(body.tool().cutting());
    EXPECT_EQ(body.cut->changes, 0);
    EXPECT_GT(body.tool().totalForce().norm(), 1e-3) << "it was pressed";
  }
}

TEST(Pierce, byNothingWithoutContactIsCounted) {
  BlockOptions options = pressing(R"(pierceCriterion="force" pierceForce="5 mN")");
  options.contact.clear();
  CutBlock body(options);
  body.advanceTo(0.04);
  EXPECT_EQ(body.cut->changes, 0);
  EXPECT_GT(body.count("untouched"), 10u);
}

// A blade pierces as it presses, and draws back at once, before the tissue has closed round it.
TEST(Pierce, isUndoneByDrawingBack) {
  BlockOptions options{
      .tools = scalpel("scalpel", "0 0.02 0.03 0.04 0.05",
                       "6.3 6.2 8  6.3 6.2 7.2  6.3 6.2 11  6.3 6.2 11  6.3 6.2 9"),
      .cut = R"(pierceCriterion="force" pierceForce="5 mN")",
      .contact = contact};
  CutBlock body(options);
  while (!body.cut->cutting && body.scene.stepCount() < 20) body.step();
  ASSERT_TRUE(body.cut->cutting);
  body.advanceTo(0.038);
  EXPECT_FALSE(body.cut->cutting);
  EXPECT_FALSE(body.tool().cutting()) << "it must pierce again";
  EXPECT_EQ(body.count("untouched"), 0u);
}

// Scalpels from the side, at 0.6 mm a step, deep enough to cut right through unless they stop.
const std::string through = "6.3 -3 -2  6.3 15 -2";

TEST(Trigger, cutsOnlyWhileHeld) {
  const std::string way = "6.3 -3 -2  6.3 6 -2  6.3 9 -2  6.3 15 -2";
  BlockOptions options{.tools = scalpel("scalpel", "0 0.015 0.02 0.03", way),
                       .cut = R"(needsTrigger="true")"};
  CutBlock never(options);
  never.advanceTo(0.03);
  EXPECT_EQ(never.cut->changes, 0);
  options.tools = scalpel("scalpel", "0 0.015 0.02 0.03", way, R"(buttons="1 0 0 0")");
  CutBlock half(options);
  half.advanceTo(0.014);
  EXPECT_TRUE(half.cut->cutting);
  half.advanceTo(0.017);
  EXPECT_FALSE(half.cut->cutting);
  const int changes = half.cut->changes;
  EXPECT_GT(changes, 0);
  half.advanceTo(0.03);
  EXPECT_EQ(half.cut->changes, changes);
  EXPECT_EQ(half.pieces(), 1);
}

TEST(SecondBlade, waitsAndIsCounted) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.03", through) +
                          scalpel("other", "0 0.03", "3.3 -3 -2  3.3 15 -2"),
                 .names = "@/scalpel @/other"});
  body.advanceTo(0.015);
  EXPECT_TRUE(body.tool(0).cutting());
  EXPECT_FALSE(body.tool(1).cutting());
  EXPECT_GT(body.count("busy"), 3u);
  body.advanceTo(0.03);
  EXPECT_EQ(body.pieces(), 2);
}

TEST(Blade, thatCutsThroughLeavesTwoPieces) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.03", through)});
  const Index triangles = static_cast<Index>(body.cut->surface().triangles().size());
  body.advanceTo(0.03);
  EXPECT_EQ(body.pieces(), 2);
  EXPECT_FALSE(body.cut->cutting);
  EXPECT_FALSE(body.tool().cutting());
  EXPECT_EQ(body.cut->engagedLength, 0);
  EXPECT_GT(static_cast<Index>(body.cut->surface().triangles().size()), triangles);
}

TEST(Blade, thatStopsHalfWayLeavesOnePiece) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.015 0.03", "6.3 -3 -2  6.3 6.2 -2  6.3 6.2 30")});
  body.advanceTo(0.03);
  EXPECT_GT(body.cut->changes, 0);
  EXPECT_FALSE(body.cut->cutting);
  EXPECT_EQ(body.pieces(), 1);
}

TEST(Blade, toAndFroInItsSlitCutsNothing) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.015 0.02 0.025 0.03 0.04 0.05",
                                  "6.3 -3 -2  6.3 6 -2  6.3 3 -2  6.3 6 -2  6.3 2 -2  6.3 6 -2 "
                                  "6.3 11 -2")});
  body.advanceTo(0.016);
  const int changes = body.cut->changes;
  const auto triangles = body.cut->surface().triangles().size();
  EXPECT_GT(changes, 0);
  body.advanceTo(0.039);
  EXPECT_LE(body.cut->changes, changes + 1) << "but for what was left to the front";
  EXPECT_LE(body.cut->surface().triangles().size(), triangles + 60);
  body.advanceTo(0.05);
  EXPECT_GT(body.cut->changes, changes + 2) << "beyond the slit's end it cuts on";
  EXPECT_EQ(body.pieces(), 1);
}

TEST(Blade, thatLeavesItsSlitSidewaysBeginsAnotherCut) {
  CutBlock body(
      {.tools = scalpel("scalpel", "0 0.015 0.02 0.03", "6.3 -3 -2  6.3 8 -2  6.3 5 -2  11 5 -2")});
  body.advanceTo(0.02);
  const int changes = body.cut->changes;
  body.advanceTo(0.03);
  EXPECT_GT(body.cut->changes, changes + 1);
  EXPECT_EQ(body.pieces(), 1);
}

// Half a millimetre a step from the side, then set to the other end of the block.
TEST(Blade, thatIsSetElsewhereCutsNothingOnTheWay) {
  CutBlock body({.tools = R"(<ScalpelTool name="scalpel" length="20 mm"/>)"});
  Tool& tool = body.tool();
  const auto move = [&](double y) {
    tool.moveTo({Vec3(6.3e-3, y, -2e-3), Quat::Identity()}, Vec3::Zero(), Vec3::Zero(), false);
  };
  for (double y = -3e-3; y < 3e-3; y += 0.5e-3) {
    move(y);
    body.step();
  }
  ASSERT_TRUE(body.cut->cutting);
  move(11e-3);
  move(11e-3);
  body.step();
  move(11e-3);
  body.step();
  for (double y = 11e-3; y < 15e-3; y += 0.5e-3) {
    move(y);
    body.step();
  }
  EXPECT_TRUE(body.cut->check().failures.empty());
  EXPECT_GT(body.cut->changes, 1);
  EXPECT_EQ(body.pieces(), 1) << "the middle of the block is whole";
}

// A blade with a width cuts one way, also when it turns about its tip, and not the other.
TEST(Blade, thatTurnsAboutItsTipCutsForwardOnly) {
  for (const double way : {1.0, -1.0}) {
    CutBlock body({.tools = R"(<ScalpelTool name="scalpel" length="20 mm" width="0.1 mm"/>)"});
    Tool& tool = body.tool();
    const auto turn = [&](double angle) {
      const Quat orientation(Eigen::AngleAxisd(way * angle, Vec3::UnitY()));
      tool.moveTo({Vec3(6e-3, 6.2e-3, -1e-3), orientation}, Vec3::Zero(), Vec3::Zero(), false);
    };
    for (double angle = -0.5; angle < 0.5; angle += 0.03) {
      turn(angle);
      body.step();
    }
    EXPECT_TRUE(body.cut->check().failures.empty());
    if (way > 0) {
      EXPECT_GT(body.cut->changes, 2);
    } else {
      EXPECT_EQ(body.cut->changes, 0);
    }
  }
}

// Reset while the blade has set in but cut nothing yet: the next entry is a new one.
TEST(Blade, forgetsOnResetWhereItHadSetIn) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.03", through)});
  while (!body.cut->cutting) body.step();
  ASSERT_EQ(body.cut->changes, 0);
  body.scene.reset();
  body.advanceTo(0.03);
  CutBlock fresh({.tools = scalpel("scalpel", "0 0.03", through)});
  fresh.advanceTo(0.03);
  EXPECT_EQ(body.scene.stateHash(), fresh.scene.stateHash());
  EXPECT_EQ(body.cut->complex().nodeCount(), fresh.cut->complex().nodeCount());
  EXPECT_EQ(body.pieces(), 2);
}

TEST(Cuts, thatCrossMakeFourPieces) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.03 0.035 0.04 0.045 0.075",
                                  through + "  6.3 15 30  -3 6.2 30  -3 6.2 -2  15 6.2 -2")});
  body.advanceTo(0.075);
  EXPECT_EQ(body.pieces(), 4);
}

TEST(Cuts, areExtended) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.015 0.02 0.025 0.045",
                                  "6.3 -3 -2  6.3 6.2 -2  6.3 6.2 30  6.3 15 30  6.3 15 -2") +
                          scalpel("other", "0.03 0.06", "6.3 15 -2  6.3 -3 -2"),
                 .names = "@/scalpel @/other"});
  body.advanceTo(0.025);
  EXPECT_EQ(body.pieces(), 1);
  body.advanceTo(0.06);
  EXPECT_EQ(body.pieces(), 2) << "from the other side, past the end of the first";
}

TEST(Cuts, madeAgainChangeNothing) {
  CutBlock body({.tools = scalpel("scalpel", "0 0.03 0.035 0.04 0.045 0.075",
                                  through + "  6.3 15 30  6.3 -3 30  6.3 -3 -2  6.3 15 -2")});
  body.advanceTo(0.045);
  EXPECT_EQ(body.pieces(), 2);
  const auto triangles = body.cut->surface().triangles().size();
  const Index nodes = body.cut->nodes().size();
  body.advanceTo(0.075);
  EXPECT_EQ(body.cut->surface().triangles().size(), triangles);
  EXPECT_EQ(body.cut->nodes().size(), nodes);
  EXPECT_EQ(body.pieces(), 2);
}

}  // namespace
}  // namespace stroma::test
