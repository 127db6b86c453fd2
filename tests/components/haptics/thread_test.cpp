// SPDX-License-Identifier: Apache-2.0
// The haptic thread beside a simulation: no races (under the thread sanitizer), no waiting, and a
// calm hand when the simulation hangs.
#include <gtest/gtest.h>

#include "core/rate_keeper.h"
#include "tests/components/haptics/touch_scene.h"

namespace stroma {
namespace {

// A stylus that is held still at a depth, and remembers every force.
class HeldDevice final : public HapticDevice {
 public:
  Attribute<double> depth{this, "depth", 0.004, "Below zero.", {.unit = "m"}};
  void bind() override {
    depth_ = depth;
    forces_.reserve(100'000);
  }
  [[nodiscard]] ToolSample read(double time) noexcept override {
    ToolSample sample;
    sample.time = time;
    sample.pose.position.z() = -depth_;
    sample.sequence = ++sequence_;
    return sample;
  }
  void write(double time, const Vec3& force, const Vec3&) noexcept override {
    if (forces_.size() < forces_.capacity()) forces_.emplace_back(time, force.z());
  }
  // After the thread has ended.
  [[nodiscard]] const std::vector<std::pair<double, double>>& forces() const { return forces_; }

 private:
  double depth_ = 0;
  std::uint64_t sequence_ = 0;
  std::vector<std::pair<double, double>> forces_;
};

template <class Device>
Device* find(const TouchScene& touch) {
  for (const auto& c : touch.scene->root().components()) {
    if (auto* found = dynamic_cast<Device*>(c.get())) return found;
  }
  return nullptr;
}

TEST(HapticThread, runsBesideTheSimulation) {
  TouchOptions options;
  options.realTime = true;
  TouchScene touch = touchScene(options);
  ASSERT_TRUE(touch.controller) << touch.problems;
  RateKeeper pace(100);
  pace.start();
  for (int i = 0; i < 120; ++i) {
    pace.wait();
    touch.step();
    // what a user does meanwhile
    if (i == 40) {
      EXPECT_FALSE(touch.scene->setAttribute("/" + touch.controller->name() + ".maxForce", "2"));
    }
    if (i == 50) static_cast<void>(touch.scene->restore(touch.scene->save()));
    if (i == 60) touch.scene->reset();
    static_cast<void>(touch.controller->pace());
    static_cast<void>(touch.controller->lastValues());
  }
  touch.scene->stop();
  const PaceStatistics s = touch.controller->pace();
  std::printf(
      "%.1f Hz, periods p50 %.3f p99 %.3f max %.3f ms, %llu of %llu missed; CPU a tick p99 "
      "%.1f us\n",
      s.rate, 1e3 * s.p50, 1e3 * s.p99, 1e3 * s.max, static_cast<unsigned long long>(s.misses),
      static_cast<unsigned long long>(s.deadlines),
      1e6 * touch.controller->cpuPerTick().quantile(0.99));
  EXPECT_GT(s.ticks, 300u);
  EXPECT_GT(touch.tissue->mostForce, 0.05);
  EXPECT_GT(touch.controller->force->z(), 0.05);
  EXPECT_EQ(*touch.controller->faults, 0);
}

TEST(HapticThread, theToolIsWhereTheHandIsFromTheFirstStepOn) {
  for (int i = 0; i < 20; ++i) {
    TouchOptions options;
    options.realTime = true;
    options.device = "<Extra/>";
    TouchScene touch = touchScene<HeldDevice>(options);
    ASSERT_TRUE(touch.controller) << touch.problems;
    touch.step();
    EXPECT_NEAR(touch.tool->pose().position.z(), -0.004, 1e-12);
    EXPECT_EQ(touch.tool->linearVelocity(), Vec3::Zero());
  }
}

TEST(HapticThread, aResetCountsFromThereOn) {
  TouchOptions options;
  options.realTime = true;
  options.device = "<Extra/>";
  options.controller = "maxForce=\"0.02\"";
  TouchScene touch = touchScene<HeldDevice>(options);
  ASSERT_TRUE(touch.controller) << touch.problems;
  RateKeeper pace(100);
  pace.start();
  for (int i = 0; i < 60; ++i) {
    pace.wait();
    touch.step();
  }
  const std::uint64_t before = touch.controller->clamped.count();
  touch.scene->reset();
  touch.step();
  pace.wait();
  touch.step();
  const std::uint64_t after = touch.controller->clamped.count();
  std::printf("%llu clamped ticks, %llu after a reset and 10 ms\n",
              static_cast<unsigned long long>(before), static_cast<unsigned long long>(after));
  EXPECT_GT(before, 100u);
  EXPECT_LT(after, before / 2);
}

TEST(HapticThread, aCheckpointInRealTimeWarnsInBatchThatItHasNoHand) {
  TouchOptions options;
  options.realTime = true;
  TouchScene live = touchScene(options);
  ASSERT_TRUE(live.controller) << live.problems;
  live.step(3);
  const Snapshot snapshot = live.scene->save();
  ASSERT_TRUE(live.scene->restore(snapshot));
  EXPECT_EQ(live.scene->diagnostics().text().find("haptic-resumed"), std::string::npos);
  options.realTime = false;
  TouchScene batch = touchScene(options);
  ASSERT_TRUE(batch.scene->restore(batch.scene->save()));
  EXPECT_EQ(batch.scene->diagnostics().text().find("haptic-resumed"), std::string::npos);
  ASSERT_TRUE(batch.scene->restore(snapshot));
  EXPECT_NE(batch.scene->diagnostics().text().find("haptic-resumed"), std::string::npos);
}

TEST(HapticThread, isStartedAndStoppedManyTimes) {
  for (int i = 0; i < 30; ++i) {
    TouchOptions options;
    options.realTime = true;
    TouchScene touch = touchScene(options);
    ASSERT_TRUE(touch.controller) << touch.problems;
    if (i % 3 == 1) touch.step();
    if (i % 3 == 2) touch.scene->stop();
  }
}

TEST(HapticThread, aSimulationThatHangsForHalfASecondFadesTheForce) {
  TouchOptions options;
  options.realTime = true;
  options.device = "<Extra name=\"hand\"/>";
  options.controller = "device=\"@hand\"";
  options.tissue = "stallAt=\"0.6\" stall=\"0.5\"";
  TouchScene touch = touchScene<HeldDevice>(options);
  ASSERT_TRUE(touch.controller) << touch.problems;
  auto* hand = find<HeldDevice>(touch);
  RateKeeper pace(100);
  pace.start();
  while (touch.scene->time() < 1) {
    pace.wait();
    touch.step();
  }
  touch.scene->stop();
  const auto& forces = hand->forces();
  ASSERT_GT(forces.size(), 500u);
  EXPECT_EQ(forces.back().second, 0) << "the last force is zero";
  // from the last full force on: how it goes and comes
  double full = 0, zeroFor = 0, down = 0, up = 0, silentFrom = 0, zeroFrom = 0;
  for (std::size_t i = 1; i + 1 < forces.size(); ++i) {
    const auto [time, f] = forces[i];
    const double change = f - forces[i - 1].second, passed = time - forces[i - 1].first;
    full = std::max(full, f);
    if (time < 0.5) continue;
    // a late tick fades for the time that it is late, up to four periods
    const double periods = std::clamp(passed / 1e-3, 1.0, 4.0);
    down = std::max(down, -change / periods);
    up = std::max(up, change / periods);
    if (f == 0) {
      zeroFor += passed;
      if (zeroFrom == 0) zeroFrom = time;
    } else if (zeroFrom == 0 && f > 0.999 * full) {
      silentFrom = time;
    }
  }
  std::printf(
      "%.3f N; from full to zero in %.0f ms, zero for %.0f ms; most change a period %.1f mN "
      "down, %.1f mN up\n",
      full, 1e3 * (zeroFrom - silentFrom), 1e3 * zeroFor, 1e3 * down, 1e3 * up);
  EXPECT_GT(full, 0.15);
  EXPECT_NEAR(zeroFrom - silentFrom, 0.05, 0.03);
  EXPECT_GT(zeroFor, 0.25);
  EXPECT_LT(down, 1.3 * full * 1e-3 / 0.05);
  EXPECT_LT(up, 0.05);
}

}  // namespace
}  // namespace stroma
