// SPDX-License-Identifier: Apache-2.0
// How well the haptic rate is kept beside a busy simulation, against an empty loop of the same
// scheduling class in alternation. STROMA_SOAK_SECONDS says how long each of the two runs (3 s if
// it is not set) and STROMA_SOAK_SLICE after how long they alternate (1 s). STROMA_SOAK_SCENE names
// a scene with a HapticController instead of the built-in one, such as cutting_hand.xml, which
// starts anew with each slice; STROMA_SOAK_PRIORITY asks for the real-time class for both.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/interfaces/observer.h"
#include "core/interfaces/topology_modifier.h"
#include "core/rate_keeper.h"
#include "core/traverse.h"
#include "tests/components/haptics/touch_scene.h"

namespace stroma {
namespace {

double environment(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : otherwise;
}

// 20 where the system grants the real-time class, 0 where it does not.
int grantedPriority() {
  const int wanted = static_cast<int>(environment("STROMA_SOAK_PRIORITY", 20));
  bool granted = false;
  std::jthread([&] { granted = setThreadPriority(wanted); }).join();
  return granted ? wanted : 0;
}

std::string environmentText(const char* name, const char* otherwise) {
  const char* text = std::getenv(name);
  return text ? text : otherwise;
}

struct Tally {
  double missed = 0, due = 0, p99 = 0, max = 0, cpu = 0, mostCpu = 0;
  int slices = 0, changes = 0;
  void add(double deadlines, double missRate, double slowest99, double slowest) {
    due += deadlines;
    missed += missRate * deadlines;
    p99 += slowest99;
    max = std::max(max, slowest);
    ++slices;
  }
  [[nodiscard]] double rate() const { return missed / due; }
};

std::unique_ptr<Scene> busyScene(int priority, bool realTime) {
  if (const char* file = std::getenv("STROMA_SOAK_SCENE")) {
    SceneOptions options;
    options.realTime = realTime;
    options.writesOutput = false;
    const std::string object = environmentText("STROMA_SOAK_CONTROLLER", "/haptics");
    options.overrides = {object + ".threadPriority=" + std::to_string(priority)};
    auto scene = std::make_unique<Scene>(options);
    EXPECT_TRUE(scene->load(file) && scene->initialise()) << scene->diagnostics().text();
    return scene;
  }
  TouchOptions options;
  options.realTime = realTime;
  // presses and lets go all the time
  options.device =
      "<SoftwareHandDevice positions=\"0 0 0.005  0 0 -0.01  0 0 0.005  0 0 -0.01  0 0 0.005\" "
      "keyTimes=\"0 0.5 1 1.5 2\"/>";
  options.tissue = "busy=\"0.007\"";
  options.controller = "threadPriority=\"" + std::to_string(priority) + "\"";
  TouchScene touch = touchScene(options);
  EXPECT_TRUE(touch.controller) << touch.problems;
  return std::move(touch.scene);
}

void stepUntil(Scene& scene, std::int64_t end) {
  RateKeeper pace(1 / scene.dt(), scene.dt());
  pace.start();
  while (monotonicNanoseconds() < end) {
    pace.wait();
    ASSERT_TRUE(scene.step());
  }
}

// The empty loop; beside it the same simulation runs as beside the haptic thread, unless
// STROMA_SOAK_ALONE is set.
void emptySlice(double seconds, int priority, Tally& tally) {
  const std::int64_t end = monotonicNanoseconds() + std::llround(1e9 * seconds);
  RateKeeper pace(1000);
  {
    std::jthread loop([&] {
      EXPECT_TRUE(setThreadPriority(priority));
      pace.start();
      while (monotonicNanoseconds() < end) pace.wait();
    });
    if (!std::getenv("STROMA_SOAK_ALONE")) stepUntil(*busyScene(priority, false), end);
  }
  const PaceStatistics s = pace.statistics();
  tally.add(static_cast<double>(s.deadlines), s.missRate(), s.p99, s.max);
}

void hapticSlice(double seconds, int priority, Tally& tally) {
  const std::unique_ptr<Scene> scene = busyScene(priority, true);
  stepUntil(*scene, monotonicNanoseconds() + std::llround(1e9 * seconds));
  scene->stop();
  for (const TopologyModifier* modifier : collect<TopologyModifier>(scene->root()))
    tally.changes += static_cast<int>(modifier->attribute("changes")->number().value_or(0));
  std::map<std::string, double> values;
  for (const Observer* observer : collect<Observer>(scene->root())) {
    for (const auto& [name, value] : observer->lastValues()) values[name] = value;
  }
  EXPECT_EQ(values["haptic_faults"], 0);
  tally.add(1000 * seconds, values["haptic_miss_rate"], values["haptic_period_p99"],
            values["haptic_period_max"]);
  tally.cpu += values["haptic_tick_cpu_p99"];
  tally.mostCpu = std::max(tally.mostCpu, values["haptic_tick_cpu_p99"]);
}

TEST(Soak, missesAreThoseOfAnEmptyLoop) {
  const double seconds = environment("STROMA_SOAK_SECONDS", 3);
  const int priority = grantedPriority();
  const int slices = std::max(2, static_cast<int>(seconds / environment("STROMA_SOAK_SLICE", 1)));
  Tally empty, haptic;
  for (int i = 0; i < slices; ++i) {
    emptySlice(seconds / slices, priority, empty);
    hapticSlice(seconds / slices, priority, haptic);
  }
  const auto print = [](const char* name, const Tally& t) {
    std::printf(
        "%s: %.0f deadlines, %.3f %% missed, period p99 %.3f ms (mean of slices), max %.2f "
        "ms\n",
        name, t.due, 100 * t.rate(), 1e3 * t.p99 / t.slices, 1e3 * t.max);
  };
  std::printf("%s class\n", priority > 0 ? "real-time" : "ordinary");
  print("empty ", empty);
  print("haptic", haptic);
  std::printf("%d topology changes beside it\n", haptic.changes);
  const double cpu = haptic.cpu / haptic.slices;
  std::printf("CPU time of a tick p99 %.1f us (mean of slices; worst slice %.1f us)\n", 1e6 * cpu,
              1e6 * haptic.mostCpu);
  // a short run on a busy machine says little: only the long one is held to the bar
  const double slack = seconds >= 30 ? 0.002 : 0.1;
  EXPECT_LE(haptic.rate(), 1.5 * empty.rate() + slack);
  EXPECT_LE(cpu, 50e-6);
}

}  // namespace
}  // namespace stroma
