// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/trial.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>
#include <map>

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/topology_modifier.h"
#include "core/traverse.h"

namespace stroma::fuzz {
namespace {

constexpr std::array<std::string_view, 4> endings = {"finite", "diagnosed", "stopped", "failed"};

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool allFinite(ConstVec3Span values) {
  return std::ranges::all_of(values, [](const Vec3& v) { return v.allFinite(); });
}

// Path of the first state with a value that is not finite, "" when there is none.
std::string notFinite(Scene& scene) {
  for (const MechanicalState* state : collect<MechanicalState>(scene.root())) {
    if (!allFinite(state->x()) || !allFinite(state->v())) return state->path();
  }
  return "";
}

class Trial {
 public:
  Trial(const RandomScene& random, const TrialFolders& folders, double seconds)
      : random_(random), seconds_(seconds), scene_(optionsOf(folders)) {}

  Outcome run() {
    const bool loaded = scene_.loadText(random_.text, "random_scene.xml") && scene_.initialise();
    if (!loaded) {
      judgeDiagnostics();
    } else {
      outcome_.ending = Ending::finite;
      judge(notFinite(scene_), " is not finite before the first step");
      advance();
      finish();
    }
    return outcome_;
  }

 private:
  void fail(const std::string& story) {
    if (outcome_.ending == Ending::failed) return;
    outcome_.ending = Ending::failed;
    outcome_.story = story;
  }
  void judge(const std::string& what, const std::string& trouble) {
    if (!what.empty()) fail(what + trouble);
  }

  void judgeDiagnostics() {
    outcome_.ending = Ending::diagnosed;
    if (scene_.diagnostics().errorCount() == 0) fail("did not load and did not say why");
    for (const Diagnostic& d : scene_.diagnostics().all()) {
      if (d.message.empty()) fail("a diagnostic without a text: " + d.id);
      if (d.where.text().empty()) fail("a diagnostic without a place: " + d.id + ", " + d.message);
      if (outcome_.story.empty() && d.severity == Severity::error) {
        outcome_.story = d.id + ": " + d.message;
      }
    }
  }

  void act(const Action& action) {
    switch (action.kind) {
      case Action::Kind::set:
        static_cast<void>(scene_.setAttribute(action.path, action.value));
        break;
      case Action::Kind::reset:
        scene_.reset();
        break;
      case Action::Kind::save:
        saved_ = scene_.save();
        savedHash_ = scene_.stateHash();
        break;
      case Action::Kind::restore:
        if (!scene_.restore(saved_)) fail("a saved state cannot be restored");
        if (scene_.stateHash() != savedHash_) fail("a restored state is another than was saved");
        break;
    }
    judge(notFinite(scene_), " is not finite after an action");
  }

  void advance() {
    const double begin = cpuSeconds();
    auto action = random_.actions.begin();
    while (outcome_.steps < random_.steps && cpuSeconds() - begin < seconds_) {
      for (; action != random_.actions.end() && action->step == outcome_.steps; ++action)
        act(*action);
      if (outcome_.ending == Ending::failed) return;
      if (!scene_.step()) return judgeStop();
      ++outcome_.steps;
      judge(notFinite(scene_), " is not finite after step " + std::to_string(outcome_.steps) +
                                   ", and the run goes on");
    }
  }

  // The guard has stopped the run: its explanation names a component and a particle of the scene.
  void judgeStop() {
    outcome_.ending = Ending::stopped;
    const auto& divergence = scene_.divergence();
    if (!divergence) return fail("step() failed without an explanation");
    outcome_.story = divergence->message;
    bool known = false;
    forEachComponent(scene_.root(),
                     [&](const Component& c) { known |= c.path() == divergence->component; });
    if (divergence->message.empty()) fail("an explanation without a text");
    if (!known) fail("an explanation that names no component: " + divergence->message);
    if (divergence->message.find(", particle ") == std::string::npos) {
      fail("an explanation that names no particle: " + divergence->message);
    }
    judge(notFinite(scene_), " is not finite after the guard has put the last good state back");
  }

  void finish() {
    for (const TopologyModifier* modifier : collect<TopologyModifier>(scene_.root())) {
      const AttributeBase* changes = modifier->attribute("changes");
      if (changes) outcome_.cuts += static_cast<int>(changes->number().value_or(0));
      if (outcome_.ending == Ending::failed) break;
      const TopologyCheck check = modifier->check();
      if (!check.failures.empty())
        fail("a cut body is not what it should be: " + check.failures[0]);
    }
    scene_.stop();
    for (const Diagnostic& d : scene_.diagnostics().all()) {
      if (d.severity == Severity::error) fail("an error while it ran: " + d.id + ", " + d.message);
    }
    std::map<std::string, std::uint64_t> counts;
    forEachComponent(scene_.root(), [&](const Component& c) {
      for (const Limiter* limiter : c.limiters()) {
        if (limiter->count() > 0)
          counts[c.type() + "." + std::string(limiter->name())] += limiter->count();
      }
    });
    outcome_.limiters.assign(counts.begin(), counts.end());
  }

  const RandomScene& random_;
  double seconds_;
  Scene scene_;
  Outcome outcome_{Ending::finite, {}, 0, 0, {}};
  Snapshot saved_;
  std::uint64_t savedHash_ = 0;
};

}  // namespace

std::string_view nameOf(Ending ending) { return endings[static_cast<std::size_t>(ending)]; }

Ending endingOf(std::string_view name) {
  const auto found = std::ranges::find(endings, name);
  return found == endings.end() ? Ending::failed : static_cast<Ending>(found - endings.begin());
}

Outcome runTrial(const RandomScene& scene, const TrialFolders& folders, double seconds) {
  try {
    return Trial(scene, folders, seconds).run();
  } catch (const std::exception& e) {
    return {Ending::failed, std::string("an exception: ") + e.what(), 0, 0, {}};
  }
}

}  // namespace stroma::fuzz
