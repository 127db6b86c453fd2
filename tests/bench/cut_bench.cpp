// SPDX-License-Identifier: Apache-2.0
#include "cut_bench.h"

#include <benchmark/benchmark.h>

#include "cut_bodies.h"

namespace stroma::bench {
namespace {

// Time of a change of the topology, the division included; counters: its parts.
void cutChange(benchmark::State& state, const std::array<Index, 3>& n, const char* gradient) {
  test::CutBody body(n, gradient);
  double division = 0, mechanics = 0, longest = 0, cuts = 0;
  for (auto _ : state) {
    const test::CutCost cost = body.cut();
    state.SetIterationTime(cost.change);
    division += cost.division;
    mechanics += cost.mechanics;
    longest = std::max(longest, cost.longest);
    ++cuts;
  }
  state.counters["division_ms"] = 1e3 * division / cuts;
  state.counters["mechanics_ms"] = 1e3 * mechanics / cuts;
  state.counters["longest_ms"] = 1e3 * longest;
}

// Mean time of a whole step of a scene while a blade is inside; counters: the worst of them, the
// mean and the worst step in which the topology changes, and of its topology work.
void cutStep(benchmark::State& state, const char* file, std::vector<std::string> overrides) {
  for (auto _ : state) {
    const test::CutTimes times = test::timesOf(std::string(STROMA_SCENES) + file, overrides);
    state.SetIterationTime(test::meanOf(times.cuttingSteps));
    state.counters["worst_ms"] = 1e3 * test::largestOf(times.cuttingSteps);
    state.counters["changes"] = static_cast<double>(times.changingSteps.size());
    state.counters["change_step_ms"] = 1e3 * test::meanOf(times.changingSteps);
    state.counters["worst_change_step_ms"] = 1e3 * test::largestOf(times.changingSteps);
    state.counters["mechanics_ms"] = 1e3 * test::meanOf(times.mechanics);
    state.counters["worst_mechanics_ms"] = 1e3 * test::largestOf(times.mechanics);
  }
}

}  // namespace

void registerCutBenchmarks() {
  for (const std::array<Index, 3>& n : test::cutBodies)
    for (const char* gradient : {"plain", "consistent"})
      benchmark::RegisterBenchmark(
          ("cut_change/" + std::to_string(n[0] * n[1] * n[2]) + "/" + gradient).c_str(), cutChange,
          n, gradient)
          ->UseManualTime()
          ->Iterations(5)
          ->Unit(benchmark::kMillisecond);
  const auto step = [](const char* name, const char* file, std::vector<std::string> overrides) {
    benchmark::RegisterBenchmark(name, cutStep, file, std::move(overrides))
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  step("cut_step/paper", "/paper/cut.xml", {});
  step("cut_step/cornea/consistent", "/cornea/cut.xml", {});
  step("cut_step/cornea/plain", "/cornea/cut.xml", {"/cornea/elasticity.gradient=plain"});
}

}  // namespace stroma::bench
