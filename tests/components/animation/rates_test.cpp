// SPDX-License-Identifier: Apache-2.0
// Calls at haptic and visual rate are counted over many steps of a scene.
#include <gtest/gtest.h>

#include <cmath>

#include "components/animation/default_animation_loop.h"
#include "components/animation/multi_rate_animation_loop.h"
#include "core/scene.h"

namespace stroma {
namespace {

class Counter final : public Component {
 public:
  void schedule(Schedule& schedule) override {
    schedule.add<&Counter::onStep>(Stage::Input, *this, "step");
    schedule.add<&Counter::onVisual>(Stage::Publish, *this, "visual", Rate::visual);
    schedule.add<&Counter::onHaptic>(Stage::Input, *this, "haptic", Rate::haptic);
  }
  void onStep(const StepContext&) { ++steps; }
  void onVisual(const StepContext&) { ++visual; }
  void onHaptic(const StepContext&) { ++haptic; }
  std::uint64_t steps = 0, visual = 0, haptic = 0;
};

class MultiRate : public testing::Test {
 protected:
  // Scene with the time step and the loop; no modules, only what is registered here.
  Counter* start(const std::string& dt, const std::string& loop) {
    scene_.registry().add<DefaultAnimationLoop>("DefaultAnimationLoop");
    scene_.registry().add<MultiRateAnimationLoop>("MultiRateAnimationLoop");
    scene_.registry().add<Counter>("Counter");
    const std::string text = "<Node dt=\"" + dt + "\">" + loop + "<Counter/></Node>";
    const bool good = scene_.loadText(text, "rates.xml") && scene_.initialise();
    EXPECT_TRUE(good) << scene_.diagnostics().text();
    return dynamic_cast<Counter*>(scene_.root().components().back().get());
  }
  void step(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(scene_.step());
  }
  static SceneOptions withoutModules() {
    SceneOptions options;
    options.pluginFolders.clear();
    return options;
  }
  Scene scene_{withoutModules()};
};

TEST_F(MultiRate, withoutALoopEveryCallIsMadeOnceAStep) {
  const Counter* counter = start("0.01", "");
  step(1000);
  EXPECT_EQ(counter->steps, 1000u);
  EXPECT_EQ(counter->visual, 1000u);
  EXPECT_EQ(counter->haptic, 1000u);
}

TEST_F(MultiRate, theDefaultLoopIsTheSameAsNone) {
  const Counter* counter = start("0.01", "<DefaultAnimationLoop/>");
  step(1000);
  EXPECT_EQ(counter->visual, 1000u);
  EXPECT_EQ(counter->haptic, 1000u);
}

TEST_F(MultiRate, hapticAndVisualRatesHoldExactlyAfterEveryStep) {
  // 1/60 of a second is no multiple of the step: counts must follow the clock without drift
  const Counter* counter =
      start("0.004", "<MultiRateAnimationLoop hapticRate=\"1000\" visualRate=\"60\"/>");
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 1; n <= 100'000; ++n) {
    ASSERT_TRUE(scene_.step());
    wrong += counter->haptic != 4 * n;
    wrong += counter->visual != 60 * 4 * n / 1000;  // floor, in whole numbers
  }
  EXPECT_EQ(wrong, 0u);
  std::printf("400 s: %llu haptic, %llu visual calls\n",
              static_cast<unsigned long long>(counter->haptic),
              static_cast<unsigned long long>(counter->visual));
  EXPECT_EQ(counter->haptic, 400'000u);
  EXPECT_EQ(counter->visual, 24'000u);
}

TEST_F(MultiRate, ratesThatDoNotDivideTheStepHoldToo) {
  const Counter* counter =
      start("0.003", "<MultiRateAnimationLoop hapticRate=\"1024\" visualRate=\"25\"/>");
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 1; n <= 50'000; ++n) {
    ASSERT_TRUE(scene_.step());
    wrong += counter->haptic != 1024 * 3 * n / 1000;
    wrong += counter->visual != 25 * 3 * n / 1000;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(counter->haptic, 153'600u);
  EXPECT_EQ(counter->visual, 3'750u);
}

TEST_F(MultiRate, aVisualRateAboveTheStepsWarnsAndGivesOneAStep) {
  const Counter* counter =
      start("0.1", "<MultiRateAnimationLoop hapticRate=\"100\" visualRate=\"60\"/>");
  EXPECT_EQ(scene_.diagnostics().warningCount(), 1);
  step(100);
  EXPECT_EQ(counter->visual, 100u);
  EXPECT_EQ(counter->haptic, 1000u);
}

TEST_F(MultiRate, theCountsGoOnAfterACheckpoint) {
  const Counter* counter =
      start("0.003", "<MultiRateAnimationLoop hapticRate=\"1024\" visualRate=\"25\"/>");
  step(101);
  const Snapshot snapshot = scene_.save();
  step(400);
  const std::uint64_t haptic = counter->haptic, visual = counter->visual;
  ASSERT_TRUE(scene_.restore(snapshot));
  step(400);
  EXPECT_EQ(counter->haptic - haptic, haptic - 1024 * 3 * 101 / 1000);
  EXPECT_EQ(counter->visual - visual, visual - 25 * 3 * 101 / 1000);
}

}  // namespace
}  // namespace stroma
