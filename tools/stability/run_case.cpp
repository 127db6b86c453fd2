// SPDX-License-Identifier: Apache-2.0
#include "tools/stability/run_case.h"

#include <chrono>
#include <iostream>

#include "core/interfaces/observer.h"
#include "core/parallel.h"
#include "core/traverse.h"
#include "tools/study/job_scene.h"
#include "tools/study/picture.h"

namespace stroma::stability {
namespace {

using study::Json;
using Clock = std::chrono::steady_clock;

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
  const std::uint64_t steps = study::stepsIn(scene.root().duration, scene);
  while (scene.stepCount() < steps) {
    if (!scene.step() || scene.diagnostics().errorCount() > 0) return false;
  }
  return true;
}

}  // namespace

Json runCase(const study::Job& job) {
  Json result = {{"id", job.id}, {"label", job.label}, {"status", "invalid"}, {"message", ""}};
  setThreadCount(job.threads);
  const auto text = study::readFile(job.scene);
  if (!text) {
    result["message"] = "cannot read '" + job.scene + "'";
    return result;
  }
  const auto begin = Clock::now();
  Scene scene(study::optionsOf(job));
  const bool ready = scene.loadText(*text, job.base) && scene.initialise();
  std::cerr << scene.diagnostics().text();
  if (!ready) {
    result["message"] = study::firstError(scene.diagnostics(), job.scene);
    return result;
  }
  const bool ended = advance(scene);
  scene.stop();
  result["seconds"] = std::chrono::duration<double>(Clock::now() - begin).count();
  result["steps"] = scene.stepCount();
  result["particles"] = scene.particleCount();
  std::string missed;
  result["checks"] = checksOf(scene, missed);
  result["limiters"] = study::limitersOf(scene);
  result["picture"] = study::pictureOf(scene);
  if (!ended && !scene.divergence()) {
    result["message"] = study::firstError(scene.diagnostics(), job.scene);
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
