// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>
#include <set>

#include "core/number_list.h"
#include "tools/study/edit_reader.h"
#include "tools/study/element_reader.h"
#include "tools/study/measure_reader.h"
#include "tools/study/study.h"

namespace stroma::study {
namespace {

const Names inQuestion{"Measure", "ReferenceRun", "Axis",    "Method", "Skip",  "Published",
                       "Budget",  "Set",          "Replace", "Remove", "Insert"};

void reportUnknown(const SceneElement& child, const std::string& parent, const Names& known,
                   Diagnostics& diagnostics) {
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  const std::string near = didYouMean(child.tag, known);
  diagnostics.error("element-unknown", "there is no " + stroma::quoted(child.tag) + " in " + parent,
                    child.at, near.empty() ? "it may hold: " + list : near);
}

class Reader {
 public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Study read(const SceneElement& root) {
    Study study;
    if (root.tag != "Study") {
      diagnostics_.error("root-not-study",
                         "the root element of a study is Study, not " + stroma::quoted(root.tag),
                         root.at);
      return study;
    }
    ElementReader reader(root, diagnostics_);
    study.title = reader.required("title");
    study.cite = reader.text("cite");
    study.text = reader.text("text");
    count(reader, "repeats", 2, 1000, study.repeats);
    count(reader, "threads", 1, 1024, study.threads);
    reader.time("timeBudget", study.timeBudget);
    reader.time("timeout", study.timeout);
    const bool several = std::ranges::any_of(
        root.children, [](const SceneElement& child) { return child.tag == "Question"; });
    if (!several) {  // the study is its one question
      readQuestion(reader, root, study.questions.emplace_back());
      study.questions.back().text.clear();  // it is the study's
      return study;
    }
    for (const SceneElement& child : root.children) {
      if (child.tag != "Question") {
        reportUnknown(child, "a Study that has Questions", {"Question"}, diagnostics_);
        continue;
      }
      ElementReader own(child, diagnostics_);
      Question& question = study.questions.emplace_back();
      own.required("name");
      readQuestion(own, child, question);
    }
    checkNames(study.questions, "Question");
    return study;
  }

 private:
  static void count(ElementReader& reader, const char* name, int least, int most, int& out) {
    int read = out;
    if (!reader.value(name, {}, read)) return;
    if (read >= least && read <= most) {
      out = read;
      return;
    }
    reader.error(reader.placeOf(name), "value-range",
                 "'" + std::string(name) + "' is from " + std::to_string(least) + " to " +
                     std::to_string(most));
  }

  template <class Item>
  void checkNames(const std::vector<Item>& items, const std::string& what) {
    std::set<std::string> taken;
    for (const Item& item : items) {
      if (item.name.empty() || taken.insert(item.name).second) continue;
      diagnostics_.error("name-repeated",
                         "there are two of the name " + stroma::quoted(item.name) + ": " + what,
                         item.at, "give each its own");
    }
  }

  // Measures may share a name where no method has both.
  void checkMeasureNames(const Question& question) {
    for (std::size_t i = 0; i < question.measures.size(); ++i) {
      const Measure& m = question.measures[i];
      const auto isOf = [](const Measure& one, const Choice& method) {
        return one.methods.empty() || fitsAny(method.name, one.methods);
      };
      const auto clashes = [&](const Measure& earlier) {
        return earlier.name == m.name && std::ranges::any_of(question.methods, [&](const auto& c) {
                 return isOf(earlier, c) && isOf(m, c);
               });
      };
      if (m.name.empty() || std::ranges::none_of(std::span(question.measures).first(i), clashes)) {
        continue;
      }
      diagnostics_.error("name-repeated",
                         "there are two of the name " + stroma::quoted(m.name) + ": Measure", m.at,
                         "give each its own, or other methods");
    }
  }

  void readQuestion(ElementReader& reader, const SceneElement& element, Question& question) {
    question.at = element.at;
    question.name = reader.text("name");
    question.text = reader.text("text");
    question.scene = reader.required("scene");
    question.sceneAt = reader.placeOf("scene");
    double time = 0;
    if (reader.time("time", time)) question.time = time;
    int steps = 0;
    count(reader, "steps", 1, 1'000'000'000, steps);
    question.steps = static_cast<std::uint64_t>(steps);
    if (question.time && steps > 0) {
      reader.error(element.at, "attr-both", "'time' and 'steps' exclude each other");
    }
    constexpr std::array<std::string_view, 2> costs{"step", "run"};
    question.costOfRun = reader.choice("cost", costs) == 1;
    // names first: the others refer to them
    for (const SceneElement& child : element.children) {
      const SceneAttribute* name = child.find("name");
      if (!name) continue;
      if (child.tag == "Method") methods_.push_back(name->value);
      if (child.tag == "ReferenceRun") references_.push_back(name->value);
    }
    for (const SceneElement& child : element.children) readChild(child, question);
    for (const SceneElement& child : element.children) {
      if (child.tag == "Skip") readSkip(child, question);
    }
    finish(element, question);
  }

  void readChild(const SceneElement& child, Question& question) {
    if (child.tag == "Measure") {
      question.measures.push_back(readMeasure(child, methods_, references_, diagnostics_));
    } else if (child.tag == "ReferenceRun") {
      readChoice(child, question.references.emplace_back());
    } else if (child.tag == "Method") {
      readChoice(child, question.methods.emplace_back());
    } else if (child.tag == "Axis") {
      readAxis(child, question.axes.emplace_back());
    } else if (child.tag == "Published") {
      readPublished(child, question);
    } else if (child.tag == "Budget") {
      readBudget(child, question);
    } else if (isAmong(child.tag, editTags)) {
      question.edits.push_back(readEdit(child, methods_, diagnostics_));
    } else if (child.tag != "Skip") {
      reportUnknown(child, "a Question", inQuestion, diagnostics_);
    }
  }

  void finish(const SceneElement& element, Question& question) {
    methods_.clear();
    references_.clear();
    if (question.measures.empty()) {
      diagnostics_.error("measure-missing", "a question needs a Measure", element.at);
    }
    checkNames(question.references, "ReferenceRun");
    checkNames(question.methods, "Method");
    checkNames(question.axes, "Axis");
    if (question.methods.empty()) question.methods.push_back({.name = "scene", .at = element.at});
    checkMeasureNames(question);
    const Axis* sized = nullptr;
    for (const Axis& axis : question.axes) {
      const bool has =
          std::ranges::any_of(axis.points, [](const Choice& p) { return p.h.has_value(); });
      if (has && sized) {
        diagnostics_.error(
            "axis-h",
            "only one axis can have sizes h; " + stroma::quoted(sized->name) + " has them already",
            axis.at);
      }
      if (has && !sized) sized = &axis;
    }
  }

  void readAxis(const SceneElement& element, Axis& axis) {
    ElementReader reader(element, diagnostics_);
    axis.name = reader.required("name");
    axis.at = element.at;
    if (axis.name == "method") {
      reader.error(reader.placeOf("name"), "axis-name", "'method' is taken: by the methods");
    }
    for (const SceneElement& child : element.children) {
      if (child.tag != "Point") {
        reportUnknown(child, "an Axis", {"Point"}, diagnostics_);
        continue;
      }
      readChoice(child, axis.points.emplace_back());
    }
    if (axis.points.empty()) {
      reader.error(element.at, "axis-empty", "an axis needs a Point");
    }
    checkNames(axis.points, "Point");
  }

  void readChoice(const SceneElement& element, Choice& choice) {
    ElementReader reader(element, diagnostics_);
    choice.name = reader.required("name");
    choice.at = element.at;
    if (element.tag == "Point") {
      Quantity h;
      if (reader.quantity("h", h)) {
        choice.h = h;
        if (h.value <= 0) {
          reader.error(reader.placeOf("h"), "value-range", "'h' is greater than 0");
        }
      }
    } else if (const SceneAttribute* scene = reader.find("scene")) {
      choice.scene = std::string(trimmed(scene->value));
      choice.sceneAt = scene->valueAt;
    }
    for (const SceneElement& child : element.children) {
      if (isAmong(child.tag, editTags)) {
        choice.edits.push_back(readEdit(child, methods_, diagnostics_));
      } else {
        reportUnknown(child, "a " + element.tag, editTags, diagnostics_);
      }
    }
  }

  void readSkip(const SceneElement& element, Question& question) {
    ElementReader reader(element, diagnostics_);
    Skip& skip = question.skips.emplace_back();
    Names known{"method"};
    for (const Axis& axis : question.axes) known.push_back(axis.name);
    for (const std::string& name : known) {
      const Names wanted = reader.names(name);
      if (wanted.empty()) continue;
      Names there = methods_;
      for (const Axis& axis : question.axes) {
        if (axis.name != name) continue;
        there.clear();
        for (const Choice& point : axis.points) there.push_back(point.name);
      }
      for (const std::string& one : wanted) {
        if (isAmong(one, there)) continue;
        reader.error(reader.placeOf(name), "skip-unknown",
                     "there is no " + name + " " + stroma::quoted(one), didYouMean(one, there));
      }
      skip.where.emplace_back(name, wanted);
    }
    if (skip.where.empty()) {
      reader.error(element.at, "skip-empty", "says nothing of what to leave out");
    }
  }

  void readPublished(const SceneElement& element, Question& question) {
    ElementReader reader(element, diagnostics_);
    Published& published = question.published.emplace_back();
    published.name = reader.required("name");
    published.source = reader.text("source");
    published.method = reader.text("method");
    if (!published.method.empty() && !isAmong(published.method, methods_)) {
      reader.error(reader.placeOf("method"), "method-unknown",
                   "there is no method " + stroma::quoted(published.method),
                   didYouMean(published.method, methods_));
    }
    double seconds = 0;
    reader.required("ms");
    reader.time("ms", seconds, true);
    published.ms = seconds * 1e3;
    double error = 0;
    if (reader.fraction("error", error)) published.error = error;
  }

  void readBudget(const SceneElement& element, Question& question) {
    ElementReader reader(element, diagnostics_);
    double error = 0, seconds = 0;
    if (reader.fraction("error", error)) question.errorBudgets.push_back(error);
    if (reader.time("ms", seconds, true)) question.msBudgets.push_back(seconds * 1e3);
    if (element.attributes.empty()) {
      reader.error(element.at, "budget-empty", "needs an 'error' or 'ms'");
    }
  }

  Diagnostics& diagnostics_;
  Names methods_, references_;  // of the question that is being read
};

Study read(const std::optional<SceneElement>& root, const std::filesystem::path& file,
           Diagnostics& diagnostics) {
  Study study;
  if (root) study = Reader(diagnostics).read(*root);
  study.file = file.string();
  return study;
}

}  // namespace

Study readStudy(const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::error_code failure;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(file, failure)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) {
    diagnostics.error("file-missing", "cannot read the study '" + file.string() + "'");
    return {};
  }
  return readStudyText({std::istreambuf_iterator<char>(stream), {}}, file, diagnostics);
}

Study readStudyText(std::string text, const std::filesystem::path& file, Diagnostics& diagnostics) {
  return read(readSceneText(std::move(text), file, {}, diagnostics), file, diagnostics);
}

}  // namespace stroma::study
