// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/mouse_device.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>

#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

MouseTarget at(double x, double y, double z, std::uint32_t buttons = 0, bool jump = false) {
  MouseTarget target;
  target.pose.position = {x, y, z};
  target.buttons = buttons;
  target.jump = jump;
  return target;
}

// A device in a scene of its own, linked into the test rather than loaded.
class Device : public ::testing::Test {
 protected:
  Device() {
    scene_.registry().add<MouseDevice>("MouseDevice");
    EXPECT_TRUE(scene_.loadText(
        "<Node name=\"root\"><MouseDevice name=\"hand\" position=\"0 0 1\" maxSpeed=\"2 m/s\" "
        "maxTurnRate=\"90\"/></Node>",
        "test.xml"));
    EXPECT_TRUE(scene_.initialise()) << scene_.diagnostics().text();
    mouse_ = collect<MouseDevice>(scene_.root()).front();
    static_cast<void>(mouse_->read(0));
  }
  Scene scene_;
  MouseDevice* mouse_ = nullptr;
};

TEST_F(Device, restsWhereItIsPut) {
  EXPECT_EQ(mouse_->read(0.1).pose.position, Vec3(0, 0, 1));
  EXPECT_EQ(mouse_->read(5).pose.position, Vec3(0, 0, 1));
}

TEST_F(Device, followsThePathAtItsSpeedRoundEveryCorner) {
  ASSERT_TRUE(mouse_->follow(at(1, 0, 1)));
  ASSERT_TRUE(mouse_->follow(at(1, 1, 1)));
  double way = 0;
  Vec3 before = Vec3(0, 0, 1);
  for (int i = 1; i <= 100; ++i) {
    const ToolSample sample = mouse_->read(0.01 * i);
    const Vec3& p = sample.pose.position;
    EXPECT_TRUE(std::abs(p.y()) < 1e-12 || std::abs(p.x() - 1) < 1e-12) << p.transpose();
    way += std::abs(p.x() - before.x()) + std::abs(p.y() - before.y());
    EXPECT_LE((p - before).norm(), 0.02 + 1e-12);
    EXPECT_NEAR((sample.linearVelocity * 0.01 - (p - before)).norm(), 0, 1e-12);
    before = p;
    if (i == 50) {
      EXPECT_NEAR(way, 1, 1e-9);
    }
  }
  EXPECT_NEAR(way, 2, 1e-9);
  EXPECT_EQ(before, Vec3(1, 1, 1));
}

TEST_F(Device, turnsAtItsRate) {
  MouseTarget target = at(0, 0, 1);
  target.pose.orientation = Quat(Eigen::AngleAxisd(3.0, Vec3::UnitX()));
  ASSERT_TRUE(mouse_->follow(target));
  const double quarter = mouse_->read(0.5).pose.orientation.angularDistance(Quat::Identity());
  EXPECT_NEAR(quarter, 0.25 * std::numbers::pi, 1e-9);
}

TEST_F(Device, pullsTheTriggerWhereThePathSaysSo) {
  ASSERT_TRUE(mouse_->follow(at(0.1, 0, 1)));
  ASSERT_TRUE(mouse_->follow(at(0.1, 0, 1, 1)));
  ASSERT_TRUE(mouse_->follow(at(0.2, 0, 1, 1)));
  EXPECT_EQ(mouse_->read(0.04).buttons, 0u);  // 8 cm of 10
  const ToolSample there = mouse_->read(0.08);
  EXPECT_EQ(there.buttons, 1u);
  EXPECT_EQ(there.pose.position, Vec3(0.1, 0, 1));  // not beyond in the same step
  EXPECT_GT(mouse_->read(0.1).pose.position.x(), 0.1);
}

TEST_F(Device, jumpsWhenToldTo) {
  ASSERT_TRUE(mouse_->follow(at(9, 9, 9, 0, true)));
  EXPECT_EQ(mouse_->read(0.001).pose.position, Vec3(9, 9, 9));
}

TEST_F(Device, refusesMoreThanItKeeps) {
  int taken = 0;
  while (mouse_->follow(at(0, 0, taken)) && taken < 100000) ++taken;
  EXPECT_GE(taken, 4000);
  EXPECT_LT(taken, 5000);
}

// What a person did is played again by a script, and the tissue has the same bits.
TEST(MouseRecording, makesTheSameStepsAgain) {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.writesOutput = false;
  const std::filesystem::path file = STROMA_SCENES "/cornea/interactive.xml";
  Scene scene(options);
  scene.registry().add<MouseDevice>("MouseDevice");
  ASSERT_TRUE(scene.load(file) && scene.initialise()) << scene.diagnostics().text();
  MouseDevice* mouse = nullptr;
  for (MouseDevice* device : collect<MouseDevice>(scene.root())) {
    if (device->name() == "probe_hand") mouse = device;
  }
  ASSERT_TRUE(mouse);
  const auto make = [&](int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(scene.step());
  };
  make(3);
  MouseTarget press = at(0, 0, 0.0003);
  press.pose.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3(1, 2, 0).normalized()));
  ASSERT_TRUE(mouse->follow(at(0, 0, 0.002, 0, true)));
  ASSERT_TRUE(mouse->follow(press));
  make(12);
  ASSERT_TRUE(mouse->follow(at(0.001, 0, 0.0003, 1)));
  ASSERT_TRUE(mouse->follow(at(0.001, 0, 0.003)));
  make(15);

  const auto folder =
      std::filesystem::temp_directory_path() / ("stroma-mouse-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "probe.csv") << mouse->recording();
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t begin = text.find("<MouseDevice name=\"probe_hand\"");
  ASSERT_NE(begin, std::string::npos);
  text.replace(begin, text.find("/>", begin) - begin,
               "<ScriptedDevice name=\"probe_hand\" filename=\"probe.csv\"");
  options.dataFolders = {folder};
  Scene again(options);
  again.registry().add<MouseDevice>("MouseDevice");
  ASSERT_TRUE(again.loadText(text, file) && again.initialise()) << again.diagnostics().text();
  const std::uint64_t start = again.stateHash();
  while (again.stepCount() < scene.stepCount()) ASSERT_TRUE(again.step());
  EXPECT_EQ(again.stateHash(), scene.stateHash());
  EXPECT_NE(again.stateHash(), start);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace stroma
