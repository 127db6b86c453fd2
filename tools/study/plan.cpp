// SPDX-License-Identifier: Apache-2.0
#include "tools/study/plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/scene_reader.h"
#include "tools/study/content_hash.h"
#include "tools/study/measures.h"
#include "tools/study/names.h"
#include "tools/study/scene_edit.h"
#include "tools/study/slurm.h"

namespace stroma::study {
namespace fs = std::filesystem;
namespace {

class Planner {
 public:
  Planner(const Study& study, const PlanOptions& options, Diagnostics& diagnostics)
      : study_(study), options_(options), diagnostics_(diagnostics) {
    for (const std::string& folder : options.data) data_.emplace_back(folder);
  }

  std::vector<Variation> make() {
    for (std::size_t q = 0; q < study_.questions.size(); ++q) {
      const Question& question = study_.questions[q];
      for (const Choice& reference : question.references) {
        Variation variation{.question = q, .method = reference.name, .isReference = true};
        prepare(question, {&reference}, variation);
        plan_.push_back(std::move(variation));
      }
    }
    for (std::size_t q = 0; q < study_.questions.size(); ++q) {
      const Question& question = study_.questions[q];
      auto all = combinations(question, q);
      if (all.empty()) {
        diagnostics_.error("study-empty", "nothing is left to run: all combinations are skipped",
                           question.at);
      }
      for (Variation& variation : all) {
        prepare(question, choicesOf(question, variation), variation);
        plan_.push_back(std::move(variation));
      }
    }
    return std::move(plan_);
  }

 private:
  // The method first: points may set what it brings.
  static std::vector<const Choice*> choicesOf(const Question& question,
                                              const Variation& variation) {
    const auto named = [](const std::vector<Choice>& among, const std::string& name) {
      return &*std::ranges::find(among, name, &Choice::name);
    };
    std::vector<const Choice*> choices{named(question.methods, variation.method)};
    for (std::size_t a = 0; a < question.axes.size(); ++a) {
      choices.push_back(named(question.axes[a].points, variation.points[a].second));
    }
    return choices;
  }

  void prepare(const Question& question, const std::vector<const Choice*>& choices,
               Variation& variation) {
    const Choice& first = *choices.front();
    const bool own = !first.scene.empty();
    const SceneElement* base = baseScene(own ? first.scene : question.scene,
                                         own ? first.sceneAt : question.sceneAt, variation);
    if (!base) return;
    SceneElement root = *base;
    std::vector<Edit> edits;
    const auto add = [&](const std::vector<Edit>& some) {
      std::ranges::copy_if(some, std::back_inserter(edits), [&](const Edit& e) {
        return e.methods.empty() || fitsAny(variation.method, e.methods);
      });
    };
    add(question.edits);
    for (const Choice* choice : choices) add(choice->edits);
    Diagnostics found;
    edit(root, edits, found);
    forward(found, edits, variation);
    if (found.errorCount() == 0) fillJob(question, root, edits, variation);
  }

  // Null when it cannot be read, which is reported once.
  const SceneElement* baseScene(const std::string& name, const SourceRange& at,
                                Variation& variation) {
    std::string searched;
    const auto file = findFile(name, fs::path(study_.file).parent_path(), data_, searched);
    if (!file) {
      if (missing_.insert(name).second) {
        diagnostics_.error("file-missing", "cannot find the scene " + stroma::quoted(name), at,
                           "searched: " + searched);
      }
      return nullptr;
    }
    variation.job.base = fs::absolute(*file).string();
    auto [entry, isNew] = scenes_.try_emplace(file->string());
    if (isNew) entry->second = readSceneFile(*file, data_, diagnostics_);
    return entry->second ? &*entry->second : nullptr;
  }

  void fillJob(const Question& question, const SceneElement& root, const std::vector<Edit>& edits,
               Variation& variation) {
    Job& job = variation.job;
    for (const Edit& e : edits) {
      if (e.kind == Edit::Kind::set) job.overrides.push_back(e.target + "=" + e.value);
    }
    for (const Measure& measure : question.measures) {
      const bool wanted = !variation.isReference || measure.referenceRun == variation.method;
      if (wanted && isOf(measure, variation.method)) {
        job.measures.push_back(measure);
      }
    }
    // as seen from anywhere: a cluster starts its tasks where it likes
    for (const std::string& folder : options_.plugins) {
      job.plugins.push_back(fs::absolute(folder).string());
    }
    for (const std::string& folder : options_.data)
      job.data.push_back(fs::absolute(folder).string());
    job.time = question.time;
    job.steps = question.steps;
    job.repeats = variation.isReference ? 1 : study_.repeats;
    job.threads = study_.threads;
    job.timeBudget = study_.timeBudget;
    job.timeout = study_.timeout;
    const std::uint64_t content = check(root, edits, variation);
    const std::string label = labelOf(variation);
    job.label = question.name.empty() ? label : question.name + ": " + label;
    const std::uint64_t whole =
        hashText(job.label + identityOf(job), hashText(sceneText(root), content));
    const std::string hash = hexText(whole).substr(0, 10);
    job.id = slug(job.label) + "-" + hash;
    const fs::path folder = variation.isReference ? options_.cache : options_.out / "results";
    job.result = fs::absolute(folder / (job.id + ".json")).string();
    job.scene = fs::absolute(options_.out / "scenes" / (job.id + ".xml")).string();
    SceneElement shown = root;
    shown.attributes.push_back({"_run", commandFor(job), {}, {}});
    variation.sceneText = sceneText(shown);
  }

  // How somebody runs the generated scene by hand.
  static std::string commandFor(const Job& job) {
    std::string command = "stroma run " + shellWord(job.scene) + " --data " +
                          shellWord(fs::path(job.base).parent_path().string());
    for (const std::string& one : job.overrides) command += " --set " + shellWord(one);
    return command;
  }

  // Reads the scene with its overrides and reports what is wrong with it. The hash of the input
  // files and of the code that will run.
  std::uint64_t check(const SceneElement& root, const std::vector<Edit>& edits,
                      const Variation& variation) {
    SceneOptions options;
    options.pluginFolders.insert(options.pluginFolders.begin(), options_.plugins.begin(),
                                 options_.plugins.end());
    options.dataFolders = data_;
    options.writesOutput = false;
    Scene scene(std::move(options));
    SceneReader(scene).read(root, variation.job.overrides);
    if (scene.diagnostics().errorCount() == 0) {
      for (const Measure& measure : variation.job.measures) {
        checkMeasure(scene, measure, scene.diagnostics());
      }
    }
    forward(scene.diagnostics(), edits, variation);
    return hashOfInputs(scene, variation.job.base);
  }

  // Takes over what was not reported yet. What the scene says of an override is moved to the `Set`
  // that it comes from.
  void forward(const Diagnostics& from, const std::vector<Edit>& edits,
               const Variation& variation) {
    for (Diagnostic d : from.all()) {
      if (d.severity == Severity::note) continue;
      if (d.where && d.where.source->name() == "--set") {
        for (const Edit& e : edits) {
          const std::string text = e.target + "=" + e.value;
          if (e.kind != Edit::Kind::set || d.where.source->text() != text) continue;
          const bool inValue = d.where.offset > e.target.size();
          SourceRange at = inValue ? e.valueAt : e.targetAt;
          at.offset += d.where.offset - (inValue ? e.target.size() + 1 : 0);
          at.length = d.where.length;
          d.where = at;
          break;
        }
      }
      if (!reported_.insert(d.where.text() + d.message).second) continue;
      d.hint +=
          (d.hint.empty() ? "" : "\n") + ("in the variation " + stroma::quoted(labelOf(variation)));
      diagnostics_.report(std::move(d));
    }
  }

  const Study& study_;
  const PlanOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<fs::path> data_;
  std::map<std::string, std::optional<SceneElement>> scenes_;
  std::set<std::string> missing_, reported_;
  std::vector<Variation> plan_;
};

}  // namespace

std::vector<Variation> makePlan(const Study& study, const PlanOptions& options,
                                Diagnostics& diagnostics) {
  return Planner(study, options, diagnostics).make();
}

}  // namespace stroma::study
