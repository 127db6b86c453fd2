// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/software_hand_device.h"

#include <gtest/gtest.h>

#include "core/scene.h"

namespace stroma {
namespace {

class SoftwareHand : public testing::Test {
 protected:
  SoftwareHandDevice* load(const std::string& attributes) {
    scene_.registry().add<SoftwareHandDevice>("SoftwareHandDevice");
    const std::string text = "<Node><SoftwareHandDevice " + attributes + "/></Node>";
    if (!scene_.loadText(text, "hand.xml") || !scene_.initialise()) return nullptr;
    return dynamic_cast<SoftwareHandDevice*>(scene_.root().components().front().get());
  }
  static SceneOptions withoutModules() {
    SceneOptions options;
    options.pluginFolders.clear();
    return options;
  }
  Scene scene_{withoutModules()};
};

TEST_F(SoftwareHand, swingsAsTheDampedOscillatorDoes) {
  // a step of force from rest: x = f/k (1 - exp(-a t) (cos w t + a/w sin w t))
  const double m = 0.2, k = 200, c = 3.05, f = 0.5;
  auto* hand = load("positions=\"0 0 0\" mass=\"0.2\" stiffness=\"200\" damping=\"3\"");
  ASSERT_TRUE(hand) << scene_.diagnostics().text();
  const double a = c / (2 * m), w = std::sqrt(k / m - a * a);
  double worst = 0;
  hand->write(0, Vec3(f, 0, 0), Vec3::Zero());
  for (int tick = 1; tick <= 1000; ++tick) {
    const double t = 1e-3 * tick;
    const double exact =
        f / k * (1 - std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)));
    worst = std::max(worst, std::abs(hand->read(t).pose.position.x() - exact));
  }
  std::printf("largest deviation %.3g of %.3g m\n", worst, f / k);
  EXPECT_LT(worst, 2e-3 * f / k);
}

TEST_F(SoftwareHand, followsItsIntentionAndPressesTheTrigger) {
  auto* hand = load(
      "positions=\"0 0 0  0.1 0 0  0.1 0.05 0\" keyTimes=\"0 1 1.5\" pressed=\"0.5 1.2\" "
      "mass=\"0.05\" "
      "friction=\"0\"");
  ASSERT_TRUE(hand) << scene_.diagnostics().text();
  ToolSample s;
  for (int tick = 1; tick <= 800; ++tick) s = hand->read(1e-3 * tick);
  EXPECT_NEAR(s.pose.position.x(), 0.08, 1e-5);
  EXPECT_NEAR(s.linearVelocity.x(), 0.1, 1e-4);
  EXPECT_EQ(s.buttons, 1u);
  EXPECT_EQ(s.sequence, 800u);
  for (int tick = 801; tick <= 3000; ++tick) s = hand->read(1e-3 * tick);
  EXPECT_LT((s.pose.position - Vec3(0.1, 0.05, 0)).norm(), 1e-7);
  EXPECT_EQ(s.buttons, 0u);
}

TEST_F(SoftwareHand, keysMustFit) {
  EXPECT_FALSE(load("positions=\"0 0 0  1 0 0\" keyTimes=\"0\""));
  EXPECT_NE(scene_.diagnostics().text().find("1 times for 2 positions"), std::string::npos);
}

}  // namespace
}  // namespace stroma
