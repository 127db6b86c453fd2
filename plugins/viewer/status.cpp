// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/status.h"

#include "core/interfaces/observer.h"
#include "core/traverse.h"
#include "plugins/viewer/scene_description.h"

namespace stroma::viewer {

using Json = nlohmann::json;

Json describe(const SessionState& session, Scene& scene) {
  Json values = Json::object(), limiters = Json::object(), haptics = Json::object();
  forEachComponent(scene.root(), [&](const Component& component) {
    for (const Limiter* limiter : component.limiters()) {
      if (limiter->count() == 0) continue;
      limiters[component.path() + "." + std::string(limiter->name())] = limiter->count();
    }
    const auto* observer = dynamic_cast<const Observer*>(&component);
    if (!observer) return;
    Json own = Json::object();
    for (const auto& [name, value] : observer->lastValues()) own[name] = values[name] = value;
    if (deviceAmong(component)) haptics[component.path()] = std::move(own);  // a hand's controller
  });
  return {{"type", "status"},
          {"playing", session.playing},
          {"speed", session.speed},
          {"realTimeFactor", session.realTimeFactor},
          {"stepTime", session.stepTime},
          {"time", scene.time()},
          {"step", scene.stepCount()},
          {"kept", session.kept},
          {"stopped", session.stopped},
          {"values", std::move(values)},
          {"haptics", std::move(haptics)},
          {"limiters", std::move(limiters)}};
}

void addTiming(Scene& scene, std::uint64_t steps, std::vector<double>& totals, Json& status) {
  const Profiler& profiler = scene.profiler();
  auto mean = [&, at = std::size_t{0}](double total) mutable {
    if (at == totals.size()) totals.push_back(total);
    const double since = total - std::exchange(totals[at++], total);
    return steps > 0 ? since / static_cast<double>(steps) : 0.0;
  };
  Json stages = Json::array();
  for (int s = 0; s < stageCount; ++s) {
    Json calls = Json::array();
    const double stage = mean(profiler.stage(s).totalMs());
    for (const Profiler::Row& row : profiler.rows(s)) {
      calls.push_back({{"component", row.component},
                       {"label", row.label},
                       {"ms", mean(row.timer.totalMs())},
                       {"p99", row.timer.percentileMs(0.99)}});
    }
    stages.push_back(
        {{"name", stageName(static_cast<Stage>(s))}, {"ms", stage}, {"calls", std::move(calls)}});
  }
  status["stages"] = std::move(stages);
}

void addEnergy(const Scene& scene, Json& status) {
  double kinetic = 0, potential = 0;
  for (const auto& system : scene.systems()) {
    kinetic += system->kineticEnergy(system->v());
    potential += system->potentialEnergy({system->x(), system->v(), scene.time()});
  }
  status["kinetic"] = kinetic;
  status["potential"] = potential;
}

std::vector<std::pair<std::string, std::string>> smallOutputs(Node& root) {
  std::vector<std::pair<std::string, std::string>> outputs;
  forEachComponent(root, [&](const Component& component) {
    for (const AttributeBase* attribute : component.attributes()) {
      if (!attribute->info().output) continue;
      const bool small = attribute->number() || dynamic_cast<const Attribute<Vec3>*>(attribute);
      if (!small) continue;
      outputs.emplace_back(component.path() + "." + std::string(attribute->name()),
                           attribute->print());
    }
  });
  return outputs;
}

}  // namespace stroma::viewer
