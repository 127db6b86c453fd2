// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "tools/stability/suite.h"
#include "tools/study/edit_reader.h"
#include "tools/study/element_reader.h"
#include "tools/study/job.h"

namespace stroma::stability {
namespace {

using study::ElementReader;
using study::Names;

class SuiteReader {
 public:
  SuiteReader(Suite& suite, Diagnostics& diagnostics) : suite_(suite), diagnostics_(diagnostics) {}

  void read(const SceneElement& root) {
    if (root.tag != "StabilitySuite") {
      diagnostics_.error("suite-root", "a suite begins with <StabilitySuite>", root.at);
      return;
    }
    {
      ElementReader reader(root, diagnostics_);
      suite_.title = reader.required("title");
      suite_.text = reader.text("text");
    }
    for (const SceneElement& child : root.children) {
      if (child.tag == "Method") methods_.push_back(nameOf(child));
    }
    for (const SceneElement& child : root.children) {
      if (child.tag == "Method") {
        readMethod(child);
      } else if (child.tag == "Case") {
        readCase(child);
      } else if (child.tag == "HeldElsewhere") {
        readElsewhere(child);
      } else {
        unknown(child, {"Method", "Case", "HeldElsewhere"});
      }
    }
    if (!suite_.methods.empty() && std::ranges::none_of(suite_.methods, &Method::isDefault)) {
      diagnostics_.error("suite-default", "no Method is a default one: nothing is promised",
                         root.at, "give default=\"true\" to at least one");
    }
    if (suite_.methods.empty()) diagnostics_.error("suite-empty", "has no Method", root.at);
    if (suite_.cases.empty()) diagnostics_.error("suite-empty", "has no Case", root.at);
  }

 private:
  static std::string nameOf(const SceneElement& element) {
    const SceneAttribute* name = element.find("name");
    return name ? name->value : "";
  }

  void unknown(const SceneElement& element, const Names& known) {
    diagnostics_.error("element-unknown", "unknown element " + stroma::quoted(element.tag),
                       element.at, didYouMean(element.tag, known));
  }

  static bool isEdit(const SceneElement& element) {
    return std::ranges::find(study::editTags, element.tag) != study::editTags.end();
  }

  bool flag(ElementReader& reader, const char* name) {
    static constexpr std::array<std::string_view, 2> words{"false", "true"};
    return reader.choice(name, words) == 1;
  }

  // Names are told apart, and short enough for a table.
  void checkName(ElementReader& reader, const std::string& name, Names& taken) {
    if (name.find(';') != std::string::npos || name.ends_with('*')) {
      reader.error(reader.placeOf("name"), "name-bad", "a name has no ';' and no '*' at its end");
    }
    if (std::ranges::find(taken, name) != taken.end()) {
      reader.error(reader.placeOf("name"), "name-twice",
                   "there is a " + stroma::quoted(name) + " already");
    }
    taken.push_back(name);
  }

  void readMethod(const SceneElement& element) {
    Method method;
    method.at = element.at;
    {
      ElementReader reader(element, diagnostics_);
      method.name = reader.required("name");
      method.text = reader.text("text");
      method.quick = flag(reader, "quick");
      method.isDefault = flag(reader, "default");
      checkName(reader, method.name, methodsTaken_);
    }
    for (const SceneElement& child : element.children) {
      if (isEdit(child)) {
        method.edits.push_back(study::readEdit(child, methods_, diagnostics_));
      } else {
        unknown(child, study::editTags);
      }
    }
    suite_.methods.push_back(std::move(method));
  }

  void readCase(const SceneElement& element) {
    Case one;
    one.at = element.at;
    {
      ElementReader reader(element, diagnostics_);
      one.name = reader.required("name");
      one.scene = reader.required("scene");
      one.sceneAt = reader.placeOf("scene");
      one.text = reader.text("text");
      one.isLong = flag(reader, "long");
      (void)reader.time("timeout", one.timeout);
      checkName(reader, one.name, casesTaken_);
    }
    for (const SceneElement& child : element.children) {
      if (isEdit(child)) {
        one.edits.push_back(study::readEdit(child, methods_, diagnostics_));
      } else if (child.tag == "NotApplicable") {
        one.notApplicable.push_back(readNotApplicable(child));
      } else {
        unknown(child, {"Set", "Replace", "Remove", "Insert", "NotApplicable"});
      }
    }
    suite_.cases.push_back(std::move(one));
  }

  NotApplicable readNotApplicable(const SceneElement& element) {
    NotApplicable out;
    ElementReader reader(element, diagnostics_);
    (void)reader.required("method");
    out.methods = reader.names("method");
    out.reason = reader.required("reason");
    for (const std::string& method : out.methods) {
      if (study::isAmong(method, methods_)) continue;
      reader.error(reader.placeOf("method"), "method-unknown",
                   "there is no method " + stroma::quoted(method), didYouMean(method, methods_));
    }
    return out;
  }

  void readElsewhere(const SceneElement& element) {
    ElementReader reader(element, diagnostics_);
    HeldElsewhere out{reader.required("name"), reader.required("test"), reader.text("text")};
    suite_.elsewhere.push_back(std::move(out));
  }

  Suite& suite_;
  Diagnostics& diagnostics_;
  Names methods_, methodsTaken_, casesTaken_;
};

}  // namespace

Suite readSuiteText(std::string text, const std::filesystem::path& file, Diagnostics& diagnostics) {
  Suite suite;
  suite.file = file.string();
  const auto root =
      parseSceneText(std::make_shared<SourceText>(file.string(), std::move(text)), diagnostics);
  if (root) SuiteReader(suite, diagnostics).read(*root);
  return suite;
}

Suite readSuite(const std::filesystem::path& file, Diagnostics& diagnostics) {
  auto text = study::readFile(file);
  if (!text) {
    diagnostics.error("file-missing", "cannot read " + stroma::quoted(file.string()));
    return {};
  }
  return readSuiteText(std::move(*text), file, diagnostics);
}

}  // namespace stroma::stability
