// SPDX-License-Identifier: Apache-2.0
// Benchmarks of the engine, each through a scene. CPU time of the calling thread; see
// tests/bench/README.md.
#include <benchmark/benchmark.h>

#include <memory>
#include <sstream>

#include "core/scene.h"
#include "cut_bench.h"
#include "limit_step.h"

namespace stroma::bench {
namespace {

struct Lattice {
  Index particles, nx, ny, nz;
};

constexpr Lattice lattices[] = {{729, 9, 9, 9}, {3136, 16, 14, 14}, {1000000, 100, 100, 100}};

std::string explicitScene(const Lattice& n, double control) {
  std::ostringstream xml;
  xml << "<Node dt=\"0.001\" gravity=\"0 0 0\"><EulerExplicitSolver substeps=\"1\"/>"
      << "<ParticleSampler name=\"particles\" layout=\"lattice\" n=\"" << n.nx << " " << n.ny << " "
      << n.nz << "\" min=\"0 0 0\" max=\"" << n.nx << " " << n.ny << " " << n.nz
      << "\" jitter=\"0.15\"/>"
      << "<MechanicalObject name=\"state\"/><DiagonalMass massDensity=\"1000\"/>"
      << "<MLSForceField strain=\"green\" youngModulus=\"1000\" poissonRatio=\"0.33\" "
         "supportCount=\"16\" "
      << "zeroEnergyControl=\"" << control << "\"/></Node>";
  return xml.str();
}

std::unique_ptr<Scene> ready(benchmark::State& state, const std::string& xml) {
  auto scene = std::make_unique<Scene>();
  if (!scene->loadText(xml, "bench.xml") || !scene->initialise()) {
    state.SkipWithError(scene->diagnostics().text().c_str());
    return nullptr;
  }
  return scene;
}

void explicitStep(benchmark::State& state, const Lattice& n, double control) {
  const auto scene = ready(state, explicitScene(n, control));
  if (!scene) return;
  for (auto _ : state) {
    if (!scene->step()) state.SkipWithError(scene->divergence()->message.c_str());
  }
  state.counters["ns_per_particle"] =
      benchmark::Counter(n.particles * 1e-9, benchmark::Counter::kIsIterationInvariantRate |
                                                 benchmark::Counter::kInvert);
}

void limitStep(benchmark::State& state, const Lattice& n) {
  LimitStep limit(n.nx, n.ny, n.nz, 16);
  for (auto _ : state) limit.step();
  state.counters["ns_per_particle"] =
      benchmark::Counter(n.particles * 1e-9, benchmark::Counter::kIsIterationInvariantRate |
                                                 benchmark::Counter::kInvert);
}

class Idle final : public Component {
 public:
  void schedule(Schedule& schedule) override {
    schedule.add<&Idle::call>(Stage::Publish, *this, "idle");
  }
  void call(const StepContext&) { benchmark::DoNotOptimize(++calls_); }

 private:
  std::uint64_t calls_ = 0;
};

// Cost of a step of 100 components that do nothing, a component.
void scheduleOverhead(benchmark::State& state) {
  Scene scene;
  scene.registry().add<Idle>("Idle");
  std::string xml = "<Node>";
  for (int i = 0; i < 100; ++i) xml += "<Idle name=\"c" + std::to_string(i) + "\"/>";
  if (!scene.loadText(xml + "</Node>", "bench.xml") || !scene.initialise()) {
    state.SkipWithError(scene.diagnostics().text().c_str());
  }
  scene.profiler().setEnabled(true);
  for (auto _ : state) {
    if (!scene.step()) state.SkipWithError("diverged");
  }
  state.counters["s_per_component"] = benchmark::Counter(
      100, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void load(benchmark::State& state, const char* file) {
  for (auto _ : state) {
    SceneOptions options;
    options.writesOutput = false;
    Scene scene(options);
    if (!scene.load(std::string(STROMA_SCENES) + file) || !scene.initialise()) {
      state.SkipWithError(scene.diagnostics().text().c_str());
    }
  }
}

void step(benchmark::State& state, const char* file) {
  SceneOptions options;
  options.writesOutput = false;
  Scene scene(options);
  if (!scene.load(std::string(STROMA_SCENES) + file) || !scene.initialise()) {
    state.SkipWithError(scene.diagnostics().text().c_str());
    return;
  }
  for (auto _ : state) {
    if (!scene.step()) state.SkipWithError(scene.divergence()->message.c_str());
  }
}

void registerAll() {
  for (const Lattice& n : lattices) {
    const std::string size = "/" + std::to_string(n.particles);
    benchmark::RegisterBenchmark(("limit_step" + size).c_str(), limitStep, n)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("explicit_step" + size).c_str(), explicitStep, n, 0.0)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("explicit_step_controlled" + size).c_str(), explicitStep, n, 0.3)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("schedule_overhead", scheduleOverhead);
  benchmark::RegisterBenchmark("cornea_load", load, "/cornea/pull.xml")
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("cornea_step", step, "/cornea/pull.xml")
      ->Unit(benchmark::kMillisecond);
  registerCutBenchmarks();
}

}  // namespace
}  // namespace stroma::bench

int main(int argc, char** argv) {
  stroma::bench::registerAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
