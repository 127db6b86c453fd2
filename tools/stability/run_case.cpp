// SPDX-License-Identifier: Apache-2.0
#include "tools/stability/run_case.h"

#include <chrono>
#include <cmath>
#include <iostream>

#include "core/interfaces/observer.h"
#include "core/parallel.h"
#include "core/scene.h"
#include "core/traverse.h"
#include "tools/study/picture.h"

namespace stroma::stability {
namespace {

using study::Json;
using Clock = std::chrono::steady_clock;

std::string firstError(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::error) return d.message;
  }
  return "the scene cannot be run";
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

// The criteria of all checks; those that were missed in a sentence.
Json checksOf(Scene& scene, std::string& missed) {
  Json checks = Json::array();
  forEachComponent(scene.root(), [&](Component& component) {
    const auto* observer = dynamic_cast<const Observer*>(&component);
    if (!observer) return;
    for (const CheckResult& check : observer->checks()) {
      checks.push_back({{"component", component.path()},
                        {"criterion", check.criterion},
                        {"passed", check.passed},
                        {"measured", check.measured},
                        {"bound", check.bound},
                        {"step", check.step},
                        {"message", check.message}});
      if (check.passed) continue;
      missed += (missed.empty() ? "" : "; ") + check.criterion + " " + check.message;
    }
  });
  return checks;
}

bool advance(Scene& scene) {
  const auto steps =
      static_cast<std::uint64_t>(std::ceil(scene.root().duration / scene.dt() - 1e-9));
  while (scene.stepCount() < steps) {
    if (!scene.step() || scene.diagnostics().errorCount() > 0) return false;
  }
  return true;
}

}  // namespace

Json runCase(const study::Job& job) {
  Json result = {{"id", job.id}, {"label", job.label}, {"status", "invalid"}, {"message", ""}};
  setThreadCount(job.threads);
  SceneOptions options;
  options.overrides = job.overrides;
  options.pluginFolders.insert(options.pluginFolders.begin(), job.plugins.begin(),
                               job.plugins.end());
  options.dataFolders.assign(job.data.begin(), job.data.end());
  options.writesOutput = false;
  const auto text = study::readFile(job.scene);
  if (!text) {
    result["message"] = "cannot read '" + job.scene + "'";
    return result;
  }
  const auto begin = Clock::now();
  Scene scene(std::move(options));
  const bool ready = scene.loadText(*text, job.base) && scene.initialise();
  std::cerr << scene.diagnostics().text();
  if (!ready) {
    result["message"] = firstError(scene.diagnostics());
    return result;
  }
  const bool ended = advance(scene);
  scene.stop();
  result["seconds"] = std::chrono::duration<double>(Clock::now() - begin).count();
  result["steps"] = scene.stepCount();
  result["particles"] = scene.particleCount();
  std::string missed;
  result["checks"] = checksOf(scene, missed);
  result["limiters"] = limitersOf(scene);
  result["picture"] = study::pictureOf(scene);
  if (!ended && !scene.divergence()) {
    result["message"] = firstError(scene.diagnostics());
  } else if (scene.divergence()) {
    result["status"] = "diverged";
    result["message"] = scene.divergence()->message;
  } else if (result["checks"].empty()) {
    result["message"] = "the scene has no criterion (StabilityCheck)";
  } else {
    result["status"] = missed.empty() ? "passed" : "failed";
    result["message"] = missed;
  }
  return result;
}

}  // namespace stroma::stability
