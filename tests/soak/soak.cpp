// SPDX-License-Identifier: Apache-2.0
// soak: ten simulated minutes at 1 kHz of touching and cutting, a fresh body every 30 seconds. It
// ends with 1 when a body diverges, misses a criterion of its scene, is not what a cut body should
// be, or when memory grows.
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>

#include "core/interfaces/integrator.h"
#include "core/interfaces/tool.h"
#include "core/interfaces/topology_modifier.h"
#include "core/scene.h"
#include "core/traverse.h"
#include "tests/soak/random_hand.h"

namespace stroma::soak {
namespace {
using Clock = std::chrono::steady_clock;

struct Plan {
  int first = 1, bodies = 20;
  double seconds = 30;  // simulated, of each body
  std::uint64_t seed = 1;
  double memoryGrowth = 8;  // MB between the end of the first body and that of the last
};

double residentMb() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576;
}

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class Soak {
 public:
  explicit Soak(const Plan& plan)
      : plan_(plan), stepsOfBody_(static_cast<std::uint64_t>(plan.seconds * 1000 + 0.5)) {}

  int run() {
    std::printf("%5s %8s %6s %8s %7s %10s %10s %8s %9s %9s\n", "body", "wall s", "cuts", "changes",
                "pieces", "incisions", "triangles", "chips", "sub-steps", "memory MB");
    double first = 0, last = 0;
    for (int body = plan_.first; body <= plan_.bodies; ++body) {
      runBody(body);
      malloc_trim(0);  // what is free but kept by the allocator is no growth
      last = residentMb();
      if (body == plan_.first) first = last;
      std::printf(" %9.1f\n", last);
      std::fflush(stdout);
    }
    return summarise(first, last);
  }

 private:
  void fail(int body, const std::string& what) {
    ++failures_;
    std::printf("\nFAILED body %d: %s\n", body, what.c_str());
  }

  SceneOptions optionsFor(int body) {
    UniformRandom random(plan_.seed * 1000 + static_cast<std::uint64_t>(body));
    const HandPath touching = touchingHand(random, plan_.seconds);
    const HandPath cutting = cuttingHand(random, plan_.seconds);
    touches_ += touching.gestures;
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    options.writesOutput = false;
    options.overrides = {"/touching_hand.keyTimes=" + touching.keyTimes,
                         "/touching_hand.positions=" + touching.positions,
                         "/cutting_hand.keyTimes=" + cutting.keyTimes,
                         "/cutting_hand.positions=" + cutting.positions};
    return options;
  }

  void runBody(int body) {
    const auto begin = Clock::now();
    Scene scene(optionsFor(body));
    if (!scene.load(STROMA_SOAK_SCENE) || !scene.initialise()) {
      return fail(body, scene.diagnostics().text());
    }
    const auto tools = collect<Tool>(scene.root());
    const auto states = collect<MechanicalState>(scene.root());
    int cuts = 0;
    bool wasCutting = false;
    double substeps = 0;
    for (std::uint64_t step = 1; step <= stepsOfBody_; ++step) {
      if (!scene.step()) {
        fail(body, scene.divergence()->message);
        break;
      }
      for (const MechanicalState* state : states) {
        if (!(flat(state->x()).allFinite() && flat(state->v()).allFinite())) {
          return fail(body, state->path() + " is not finite after step " + std::to_string(step));
        }
      }
      const bool isCutting = std::ranges::any_of(tools, [](const Tool* t) { return t->cutting(); });
      cuts += isCutting && !wasCutting ? 1 : 0;
      wasCutting = isCutting;
      const double made = substepsOf(scene);
      substeps = std::max(substeps, made);
      showProgress(body, step, made);
    }
    steps_ += scene.stepCount();
    endBody(scene, body, cuts, begin);
    std::printf(" %9.0f", substeps);
  }

  static double substepsOf(const Scene& scene) {
    double most = 0;
    for (const auto& system : scene.systems()) {
      const AttributeBase* made = system->integrator().attribute("currentSubsteps");
      if (made) most = std::max(most, made->number().value_or(0));
    }
    return most;
  }

  void endBody(Scene& scene, int body, int cuts, Clock::time_point begin) {
    std::map<std::string, double> values;
    std::size_t triangles = 0;
    for (const TopologyModifier* modifier : collect<TopologyModifier>(scene.root())) {
      const TopologyCheck check = modifier->check();
      for (const std::string& failure : check.failures) fail(body, failure);
      for (const auto& [name, value] : modifier->lastValues()) values[name] = value;
      triangles += modifier->surface().triangles().size();
    }
    scene.stop();
    forEachComponent(scene.root(), [&](Component& c) {
      for (const Limiter* limiter : c.limiters()) {
        limiters_[c.path() + "." + std::string(limiter->name())] += limiter->count();
      }
      const AttributeBase* changed = c.attribute("changes");
      if (changed && changed->number()) values["changes"] = *changed->number();
      const auto* observer = dynamic_cast<const Observer*>(&c);
      if (!observer) return;
      for (const CheckResult& check : observer->checks()) {
        CheckResult& worst =
            worst_.try_emplace(c.name() + "." + check.criterion, check).first->second;
        if (check.measured > worst.measured) worst = check;
        if (!check.passed) fail(body, c.path() + ": " + check.criterion + " is " + check.message);
      }
    });
    cuts_ += cuts;
    changes_ += static_cast<long>(values["changes"]);
    std::printf("%5d %8.1f %6d %8.0f %7.0f %7.1f mm %10zu %8.0f", body, secondsSince(begin), cuts,
                values["changes"], values["pieces"], 1000 * values["incision_length"], triangles,
                values["free_chips"]);
  }

  // On a terminal now and then, in a log twice a minute.
  void showProgress(int body, std::uint64_t step, double substeps) {
    if (step % 100 != 0) return;
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (secondsSince(shown_) < (terminal ? 0.5 : 30)) return;
    shown_ = Clock::now();
    const int count = plan_.bodies - plan_.first + 1;
    const double done =
        (body - plan_.first + static_cast<double>(step) / static_cast<double>(stepsOfBody_)) /
        count;
    const auto left = static_cast<long>(secondsSince(begin_) * (1 - done) / done);
    std::fprintf(stderr, "%ssoak: body %d of %d, %.1f %%, %.0f sub-steps, %ld:%02ld left%s",
                 terminal ? "\r" : "", body, plan_.bodies, 100 * done, substeps, left / 60,
                 left % 60, terminal ? "\033[K\r" : "\n");
  }

  int summarise(double first, double last) {
    std::printf("limiters, and how often they acted\n");
    for (const auto& [name, count] : limiters_) {
      std::printf("  %-40s %llu\n", name.c_str(), static_cast<unsigned long long>(count));
    }
    std::printf("criteria, at worst\n");
    for (const auto& [name, check] : worst_) {
      std::printf("  %-40s %s\n", name.c_str(), check.message.c_str());
    }
    std::printf(
        "resident memory %.1f MB after the first body, %.1f MB after the last; bound %+.1f MB\n",
        first, last, plan_.memoryGrowth);
    if (last - first > plan_.memoryGrowth) fail(plan_.bodies, "memory has grown");
    const double wall = secondsSince(begin_);
    std::printf(
        "%.0f s of wall clock, %.3f ms a step, %ld touches, %ld cuts, %ld topology changes\n", wall,
        1000 * wall / static_cast<double>(std::max<std::uint64_t>(steps_, 1)), touches_, cuts_,
        changes_);
    std::printf("%d bodies, %llu steps, %d failures\n", plan_.bodies,
                static_cast<unsigned long long>(steps_), failures_);
    return failures_ > 0 ? 1 : 0;
  }

  Plan plan_;
  std::uint64_t stepsOfBody_;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
  int failures_ = 0;
  long cuts_ = 0, changes_ = 0, touches_ = 0;
  std::uint64_t steps_ = 0;
  std::map<std::string, std::uint64_t> limiters_;
  std::map<std::string, CheckResult> worst_;
};

}  // namespace
}  // namespace stroma::soak

int main(int argc, char** argv) {
  stroma::soak::Plan plan;
  CLI::App app("Touches and cuts the paper's cornea at 1 kHz with random hands, body after body.",
               "soak");
  app.add_option("--bodies", plan.bodies, "Fresh bodies, one after the other")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--first", plan.first, "Body to begin with: those before are left out")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", plan.seconds, "Simulated seconds of each")
      ->option_text("T")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", plan.seed, "Other seeds are other hands")
      ->option_text("S")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return stroma::soak::Soak(plan).run();
}
