// SPDX-License-Identifier: Apache-2.0
// What cutting costs: times of the topology work and of whole steps of scenes that cut, as CPU time
// of one thread, which other work on the machine disturbs least.
#pragma once

#include <ctime>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/interfaces/mesh.h"
#include "core/interfaces/topology_modifier.h"
#include "core/parallel.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma::test {

// CPU time of the calling thread [s].
inline double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Notes when the topologies have followed a change; force fields and mappings are next.
class StartClock final : public Topology {
 public:
  Link<Topology> after{this, "after", "The surface.", Lookup::explicitOnly};
  void topologyChanged(const TopologyChange&) override { at = threadSeconds(); }
  [[nodiscard]] ConstVec3Span positions() const override { return {}; }
  static inline double at = 0;
};

// Notes how long they took. The first component of a scene, but for those.
class StopClock final : public Component {
 public:
  void topologyChanged(const TopologyChange&) override {
    took.push_back(threadSeconds() - StartClock::at);
  }
  static inline std::vector<double> took;
};

inline void addClocks(Registry& registry) {
  registry.add<StartClock>("StartClock");
  registry.add<StopClock>("StopClock");
}

inline double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}
inline double largestOf(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

struct CutTimes {
  // s: whole steps in which a blade was inside and steps that changed the topology; in the latter
  // the topology's stage, and of that the force fields and mappings alone
  std::vector<double> cuttingSteps, changingSteps, topology, mechanics;
};

// Runs a scene of a body "cornea" whose cut surface is cornea/surface/mesh, in one thread.
inline CutTimes timesOf(const std::string& file, const std::vector<std::string>& overrides = {}) {
  setThreadCount(1);
  std::stringstream stream;
  stream << std::ifstream(file).rdbuf();
  std::string text = stream.str();
  const std::string loop = "<DefaultAnimationLoop/>";
  text.replace(
      text.find(loop), loop.size(),
      "<Node name=\"clock\"><StartClock after=\"@/cornea/surface/mesh\"/><StopClock/></Node>" +
          loop);
  SceneOptions options;
  options.writesOutput = false;
  options.overrides = overrides;
  Scene scene(options);
  addClocks(scene.registry());
  if (!scene.loadText(text, file) || !scene.initialise())
    throw std::runtime_error(scene.diagnostics().text());
  const AttributeBase* cutting =
      collect<TopologyModifier>(scene.root()).front()->attribute("cutting");
  scene.profiler().setEnabled(true);
  StopClock::took.clear();
  CutTimes times;
  const auto steps = static_cast<int>(scene.root().duration / scene.dt());
  for (int k = 0; k < steps; ++k) {
    const std::size_t changes = StopClock::took.size();
    const Timer& stage = scene.profiler().stage(static_cast<int>(Stage::Topology));
    const double topologyBefore = stage.totalMs(), start = threadSeconds();
    if (!scene.step()) throw std::runtime_error(scene.divergence()->message);
    const double took = threadSeconds() - start;
    if (cutting->print() == "true") times.cuttingSteps.push_back(took);
    if (StopClock::took.size() == changes) continue;
    times.changingSteps.push_back(took);
    times.topology.push_back(1e-3 * (stage.totalMs() - topologyBefore));
  }
  times.mechanics = StopClock::took;
  return times;
}

}  // namespace stroma::test
