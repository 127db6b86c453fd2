// SPDX-License-Identifier: Apache-2.0
#include "tools/stability/suite_plan.h"

#include <algorithm>
#include <set>

#include "core/scene_reader.h"
#include "tools/study/names.h"
#include "tools/study/scene_edit.h"
#include "tools/study/slurm.h"

namespace stroma::stability {
namespace fs = std::filesystem;
namespace {

using study::Edit;

std::string nameOf(const SceneElement& element) {
  const SceneAttribute* name = element.find("name");
  return name ? name->value : element.tag;
}

// The element that a path names, null when there is none.
const SceneElement* find(const SceneElement& root, const std::string& path) {
  const SceneElement* element = &root;
  for (std::size_t begin = 1; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const auto found =
        std::ranges::find(element->children, path.substr(begin, end - begin), nameOf);
    if (found == element->children.end()) return nullptr;
    element = &*found;
    begin = end + 1;
  }
  return element;
}

// Puts the attributes of the element that is replaced in place of "{name}".
void takeOver(const SceneElement& replaced, SceneElement& element) {
  std::erase_if(element.attributes, [&](SceneAttribute& a) {
    if (!a.value.starts_with('{') || !a.value.ends_with('}')) return false;
    const SceneAttribute* old = replaced.find(a.value.substr(1, a.value.size() - 2));
    if (old) a.value = old->value;
    return old == nullptr;
  });
  for (SceneElement& child : element.children) takeOver(replaced, child);
}

class Planner {
 public:
  Planner(const Suite& suite, const PlanOptions& options, Diagnostics& diagnostics)
      : suite_(suite), options_(options), diagnostics_(diagnostics) {
    for (const std::string& folder : options.data) data_.emplace_back(folder);
  }

  std::vector<Cell> make() {
    std::vector<Cell> cells;
    for (std::size_t c = 0; c < suite_.cases.size(); ++c) {
      const bool wanted = isWanted(suite_.cases[c]);
      const bool read = !wanted || readScene(suite_.cases[c]);
      for (std::size_t m = 0; m < suite_.methods.size(); ++m) {
        Cell cell{.caseNumber = c, .method = m};
        cell.notApplicable = reasonAgainst(suite_.cases[c], suite_.methods[m]);
        cell.skipped = !wanted || !isWanted(suite_.methods[m]);
        if (cell.notApplicable.empty() && !cell.skipped && read) prepare(cell);
        cells.push_back(std::move(cell));
      }
    }
    return cells;
  }

 private:
  [[nodiscard]] bool isWanted(const Case& one) const {
    if (!options_.cases.empty()) return study::fitsAny(one.name, options_.cases);
    return !(options_.quick && one.isLong);
  }
  [[nodiscard]] bool isWanted(const Method& method) const {
    if (!options_.methods.empty()) return study::fitsAny(method.name, options_.methods);
    return !options_.quick || method.quick;
  }

  static std::string reasonAgainst(const Case& one, const Method& method) {
    for (const NotApplicable& against : one.notApplicable) {
      if (study::fitsAny(method.name, against.methods)) return against.reason;
    }
    return "";
  }

  bool readScene(const Case& one) {
    std::string searched;
    const auto file = findFile(one.scene, fs::path(suite_.file).parent_path(), data_, searched);
    if (!file) {
      diagnostics_.error("file-missing", "cannot find the scene " + stroma::quoted(one.scene),
                         one.sceneAt, "searched: " + searched);
      return false;
    }
    base_ = fs::absolute(*file).string();
    scene_ = readSceneFile(*file, data_, diagnostics_);
    return scene_.has_value();
  }

  void prepare(Cell& cell) {
    const Case& one = suite_.cases[cell.caseNumber];
    const Method& method = suite_.methods[cell.method];
    SceneElement root = *scene_;
    const std::string label = one.name + ": " + method.name;
    std::vector<Edit> edits;
    for (const auto* list : {&method.edits, &one.edits}) {
      for (Edit e : *list) {
        if (!e.methods.empty() && !study::fitsAny(method.name, e.methods)) continue;
        const SceneElement* replaced =
            e.kind == Edit::Kind::replace ? find(root, e.target) : nullptr;
        for (SceneElement& element : e.elements) {
          if (replaced) takeOver(*replaced, element);
        }
        Diagnostics found;
        study::edit(root, {e}, found);
        forward(found, {e}, label);
        edits.push_back(std::move(e));
      }
    }
    study::Job& job = cell.job;
    for (const Edit& e : edits) {
      if (e.kind == Edit::Kind::set) job.overrides.push_back(e.target + "=" + e.value);
    }
    for (const std::string& folder : options_.plugins) {
      job.plugins.push_back(fs::absolute(folder).string());
    }
    for (const fs::path& folder : data_) job.data.push_back(fs::absolute(folder).string());
    job.label = label;
    job.id = freeId(study::slug(one.name) + "--" + study::slug(method.name));
    job.base = base_;
    job.scene = fs::absolute(options_.out / "scenes" / (job.id + ".xml")).string();
    job.result = fs::absolute(options_.out / "results" / (job.id + ".json")).string();
    job.timeout = one.timeout;
    check(root, edits, job);
    root.attributes.push_back({"_run", commandFor(job), {}, {}});
    cell.sceneText = study::sceneText(root);
  }

  // Names that differ in what files cannot be called get numbers.
  std::string freeId(const std::string& wanted) {
    std::string id = wanted;
    for (int k = 2; !ids_.insert(id).second; ++k) id = wanted + "-" + std::to_string(k);
    return id;
  }

  // How somebody runs the scene by hand.
  static std::string commandFor(const study::Job& job) {
    std::string command = "stroma run " + study::shellWord(job.scene) + " --data " +
                          study::shellWord(fs::path(job.base).parent_path().string());
    for (const std::string& one : job.overrides) command += " --set " + study::shellWord(one);
    return command;
  }

  void check(const SceneElement& root, const std::vector<Edit>& edits, const study::Job& job) {
    SceneOptions options;
    options.pluginFolders.insert(options.pluginFolders.begin(), options_.plugins.begin(),
                                 options_.plugins.end());
    options.dataFolders = data_;
    options.writesOutput = false;
    Scene scene(std::move(options));
    SceneReader(scene).read(root, job.overrides);
    forward(scene.diagnostics(), edits, job.label);
  }

  // Takes over what was not reported yet; what the scene says of an override is moved to its Set.
  void forward(const Diagnostics& from, const std::vector<Edit>& edits, const std::string& label) {
    for (Diagnostic d : from.all()) {
      if (d.severity != Severity::error) continue;
      if (d.where && d.where.source->name() == "--set") {
        const auto set = std::ranges::find_if(edits, [&](const Edit& e) {
          return e.kind == Edit::Kind::set && d.where.source->text() == e.target + "=" + e.value;
        });
        if (set != edits.end()) {
          d.where = d.where.offset > set->target.size() ? set->valueAt : set->targetAt;
        }
      }
      if (!reported_.insert(d.where.text() + d.message).second) continue;
      d.hint += (d.hint.empty() ? "" : "\n") + ("in the run " + stroma::quoted(label));
      diagnostics_.report(std::move(d));
    }
  }

  const Suite& suite_;
  const PlanOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<fs::path> data_;
  std::string base_;
  std::optional<SceneElement> scene_;
  std::set<std::string> reported_, ids_;
};

}  // namespace

std::vector<Cell> makePlan(const Suite& suite, const PlanOptions& options,
                           Diagnostics& diagnostics) {
  return Planner(suite, options, diagnostics).make();
}

}  // namespace stroma::stability
