// SPDX-License-Identifier: Apache-2.0
// A hand, a tool and a tissue in one scene, in lock-step.
#include <gtest/gtest.h>

#include "tests/components/haptics/touch_scene.h"

namespace stroma {
namespace {

TEST(Controller, theHandFeelsWhatTheTissueGets) {
  TouchScene touch = touchScene({});
  ASSERT_TRUE(touch.controller) << touch.problems;
  EXPECT_TRUE(touch.tool->driven());
  EXPECT_TRUE(touch.problems.empty()) << touch.problems;
  touch.step(300);
  // all springs in series: hand 200, coupling 500, contact 300, tissue 60 N/m, over 10 mm
  const double expected = 0.01 / (1 / 200.0 + 1 / 500.0 + 1 / 300.0 + 1 / 60.0);
  const Vec3 force = touch.controller->force;
  std::printf("hand %.6f N, tissue %.6f N, expected %.6f N\n", force.z(),
              60 * -touch.tissue->height, expected);
  EXPECT_NEAR(force.z(), expected, 1e-6);
  EXPECT_NEAR(60 * -touch.tissue->height, expected, 1e-6);
  EXPECT_NEAR(touch.controller->modelAge, 0.01, 1e-9);
  EXPECT_EQ(*touch.controller->faults, 0);
}

TEST(Controller, lockStepGivesTheSameBits) {
  TouchScene a = touchScene({}), b = touchScene({});
  ASSERT_TRUE(a.controller && b.controller);
  a.step(200);
  b.step(200);
  EXPECT_GT(a.tissue->mostForce, 0.1);
  EXPECT_EQ(a.tissue->trace, b.tissue->trace);
  EXPECT_EQ(a.controller->energy.value(), b.controller->energy.value());
  const std::uint64_t first = a.tissue->trace;
  a.tissue->trace = hashBytes({});
  a.scene->reset();
  a.tissue->trace = hashBytes({});
  a.step(200);
  // the tool is set to the hand's place at once, so where it was before does not matter
  EXPECT_EQ(a.tissue->trace, first);
}

TEST(Controller, goesOnFromACheckpointWithTheSameBits) {
  TouchScene a = touchScene({});
  ASSERT_TRUE(a.controller);
  a.step(83);
  const Snapshot snapshot = a.scene->save();
  const Pose pose = a.tool->pose();
  a.step(100);
  const std::uint64_t trace = a.tissue->trace;
  const Vec3 force = a.controller->force;
  const double height = a.tissue->height;
  EXPECT_GT(force.z(), 0.1);
  ASSERT_TRUE(a.scene->restore(snapshot));
  EXPECT_NE(a.tissue->trace, trace);
  a.tool->moveTo(pose, Vec3::Zero(), Vec3::Zero(), false);  // this tool keeps nothing
  a.step(100);
  EXPECT_EQ(a.controller->force.value(), force);
  EXPECT_EQ(a.tissue->height, height);
  EXPECT_EQ(a.tissue->trace, trace);
}

// A contact whose force is other than stiffness times depth, as a constraint's or a damped one's.
class Constraint final : public Component {
 public:
  Attribute<double> pressing{this, "pressing", 0.3, "Force while inside.", {.unit = "N"}};
  Link<Tool> tool{this, "tool", "What touches.", Lookup::nearest};
  void schedule(Schedule& schedule) override {
    schedule.add<&Constraint::press>(Stage::Solve, *this, "press");
  }

 private:
  void press(const StepContext&) {
    Contact contact;
    contact.depth = -tool->pose().position.z();
    contact.stiffness = 300;
    contact.force = {0, 0, contact.depth > 0 ? *pressing : 0};
    tool->setContacts({&contact, 1U});
  }
};

TEST(Controller, theHandFeelsTheContactsForceAndNotStiffnessTimesDepth) {
  for (const double pressing : {0.3, 1.0, 0.0}) {
    TouchOptions options;
    options.device =
        "<SoftwareHandDevice positions=\"0 0 0.005  0 0 -0.01\" keyTimes=\"0 0.5\"/><Extra "
        "pressing=\"" +
        ValueTraits<double>::print(pressing) + "\"/>";
    TouchScene touch = touchScene<Constraint>(options);
    ASSERT_TRUE(touch.controller) << touch.problems;
    touch.step(400);
    const double felt = touch.controller->force->z(), depth = -touch.tool->pose().position.z();
    std::printf("contact %.3f N, felt %.9f N, stiffness times depth %.3f N\n", pressing, felt,
                300 * depth);
    // the tool rests where hand (200 N/m) and coupling (500 N/m) hold that force
    EXPECT_NEAR(felt, pressing, 1e-6);
    EXPECT_NEAR(depth, 0.01 - pressing * (1 / 200.0 + 1 / 500.0), 1e-8);
  }
}

TEST(Controller, aSecondOneOnADeviceOrAToolIsAnError) {
  TouchOptions options;
  options.device = "<SoftwareHandDevice positions=\"0 0 1\"/><HapticController name=\"first\"/>";
  EXPECT_NE(touchScene(options).problems.find("haptic-second"), std::string::npos);
  options.device =
      "<SoftwareHandDevice name=\"a\" positions=\"0 0 1\"/><SoftwareHandDevice name=\"b\" "
      "positions=\"0 0 1\"/><HapticController name=\"first\" device=\"@a\"/>";
  options.controller = "device=\"@b\"";
  EXPECT_NE(touchScene(options).problems.find("haptic-second"), std::string::npos);
}

TEST(Controller, otherForcesOnTheToolReachTheHand) {
  struct Puller final : Component {
    Link<Tool> tool{this, "tool", "", Lookup::nearest};
    void schedule(Schedule& schedule) override {
      schedule.add<&Puller::pull>(Stage::Solve, *this, "pull");
    }
    void pull(const StepContext&) { tool->addForce(Vec3(0.3, 0, 0), Vec3::Zero()); }
  };
  TouchOptions options;
  options.device = "<SoftwareHandDevice positions=\"0 0 0.01\"/><Extra/>";
  // the pull works on the hand, which has done none before
  options.controller = "energyReserve=\"1\"";
  TouchScene touch = touchScene<Puller>(options);
  ASSERT_TRUE(touch.controller) << touch.problems;
  touch.step(300);
  EXPECT_LT((touch.controller->force.value() - Vec3(0.3, 0, 0)).norm(), 1e-3);
  EXPECT_NEAR(touch.controller->stylusPosition->x(), 0.3 / 200, 1e-5);
}

TEST(Controller, aCouplingBeyondTheStableRangeWarns) {
  TouchOptions options;
  options.controller = "couplingStiffness=\"3000\"";
  EXPECT_NE(touchScene(options).problems.find("haptic-stiff"), std::string::npos);
  options.controller = "couplingStiffness=\"1000\" couplingDamping=\"0.5\"";
  EXPECT_EQ(touchScene(options).problems, "");
}

}  // namespace
}  // namespace stroma
