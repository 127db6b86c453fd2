// SPDX-License-Identifier: Apache-2.0
#include "tools/study/job_scene.h"

#include <algorithm>
#include <cmath>

#include "core/traverse.h"

namespace stroma::study {

SceneOptions optionsOf(const Job& job) {
  SceneOptions options;
  options.overrides = job.overrides;
  options.pluginFolders.insert(options.pluginFolders.begin(), job.plugins.begin(),
                               job.plugins.end());
  options.dataFolders.assign(job.data.begin(), job.data.end());
  options.writesOutput = false;
  return options;
}

std::string firstError(const Diagnostics& diagnostics, const std::string& file) {
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity != Severity::error) continue;
    if (!d.where || d.where.source->name() == "--set") return d.message;
    const auto at = d.where.source->position(d.where.offset);
    return std::filesystem::path(file).filename().string() + ":" + std::to_string(at.line) + ":" +
           std::to_string(at.column) + ": " + d.message;
  }
  return "the scene cannot be run";
}

std::uint64_t stepsIn(double time, const Scene& scene) {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(time / scene.dt() - 1e-9)));
}

Json limitersOf(Scene& scene) {
  Json limiters = Json::object();
  forEachComponent(scene.root(), [&](Component& component) {
    for (const Limiter* limiter : component.limiters()) {
      if (limiter->count() == 0) continue;
      limiters[component.path() + "." + std::string(limiter->name())] = limiter->count();
    }
  });
  return limiters;
}

}  // namespace stroma::study
