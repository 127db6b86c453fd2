// SPDX-License-Identifier: Apache-2.0
#include "tools/view/scene_changes.h"

#include <algorithm>

#include "core/path.h"
#include "tools/study/scene_edit.h"

namespace stroma::view {
namespace {

using Kind = SceneChange::Kind;

// The place of what a person typed into a window.
SourceRange placeOf(const std::string& text) {
  const auto source = std::make_shared<SourceText>("(change)", text);
  return {source, 0, text.size()};
}

std::vector<SceneElement> elementsOf(const std::string& text, Diagnostics& diagnostics) {
  const auto source = std::make_shared<SourceText>("(change)", "<Node>" + text + "</Node>");
  auto all = parseSceneText(source, diagnostics);
  return all ? std::move(all->children) : std::vector<SceneElement>();
}

void setAttribute(SceneElement& element, const std::string& name, const std::string& value) {
  const auto known = std::ranges::find(element.attributes, name, &SceneAttribute::name);
  if (known != element.attributes.end()) {
    known->value = value;
  } else {
    element.attributes.push_back({name, value, placeOf(name), placeOf(value)});
  }
}

// The element that is there with another type: it keeps its name, and the attributes and links that
// the new type has, too.
std::vector<SceneElement> retyped(SceneElement& root, const SceneChange& change, Scene& scene,
                                  Diagnostics& diagnostics) {
  const SceneElement* old = study::elementAt(root, change.path);
  const ModuleManifest* module = scene.modules().moduleOf(change.text);
  std::string problem;
  if (!old) problem = "the scene has no " + stroma::quoted(change.path);
  if (old && !module) problem = "there is no component " + stroma::quoted(change.text);
  if (problem.empty() && !scene.modules().load(*module, scene.registry(), problem)) {
    problem += " (" + stroma::quoted(change.text) + ")";
  }
  const ComponentEntry* entry = scene.registry().find(change.text);
  if (!problem.empty() || !entry) {
    diagnostics.error("change-type", problem, placeOf(change.text));
    return {};
  }
  const std::unique_ptr<Component> sample = scene.registry().create(*entry);
  SceneElement element = *old;
  setAttribute(element, "name", study::nameOf(*old));
  element.tag = change.text;
  std::erase_if(element.attributes, [&](const SceneAttribute& a) {
    return a.name != "name" && a.name != "template" && !sample->attribute(a.name) &&
           !sample->link(a.name);
  });
  return {element};
}

}  // namespace

std::string SceneChange::describe() const {
  switch (kind) {
    case Kind::set:
      return path + " = " + text;
    case Kind::replace:
      return path + " is now " + text;
    default:
      return path + " has " + text;
  }
}

void SceneChanges::add(SceneChange change) {
  if (change.kind == Kind::set) {  // dragging a slider is one change
    const bool again = !changes_.empty() && changes_.back().kind == Kind::set &&
                       changes_.back().path == change.path;
    if (again) changes_.pop_back();
  }
  changes_.push_back(std::move(change));
}

bool SceneChanges::undo() {
  if (changes_.empty()) return false;
  changes_.pop_back();
  return true;
}

std::vector<std::string> SceneChanges::describe() const {
  std::vector<std::string> lines;
  for (const SceneChange& change : changes_) lines.push_back(change.describe());
  return lines;
}

void SceneChanges::apply(SceneElement& root, Scene& scene, Diagnostics& diagnostics) const {
  for (const SceneChange& change : changes_) {
    if (change.kind == Kind::set) continue;
    const bool isElement = change.text.starts_with('<');
    study::Edit edit;
    edit.kind =
        change.kind == Kind::replace ? study::Edit::Kind::replace : study::Edit::Kind::insert;
    edit.target = change.path;
    edit.targetAt = placeOf(change.path);
    edit.elements = isElement || change.kind == Kind::insert
                        ? elementsOf(change.text, diagnostics)
                        : retyped(root, change, scene, diagnostics);
    if (!edit.elements.empty()) study::edit(root, {edit}, diagnostics);
  }
}

std::vector<std::string> SceneChanges::overrides() const {
  std::vector<std::string> assignments;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const SceneChange& change = changes_[i];
    if (change.kind != Kind::set) continue;
    // what was set of a component that was replaced afterwards went with it
    const std::string object(splitPath(change.path).object);
    const bool replaced = std::any_of(
        changes_.begin() + static_cast<std::ptrdiff_t>(i), changes_.end(),
        [&](const SceneChange& c) { return c.kind == Kind::replace && c.path == object; });
    if (!replaced) assignments.push_back(change.path + "=" + change.text);
  }
  return assignments;
}

void SceneChanges::write(SceneElement& root, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) {
    const std::size_t equals = assignment.find('=');
    const std::string path = assignment.substr(0, equals);
    const PathParts parts = splitPath(path);
    SceneElement* element = study::elementAt(root, parts.object);
    if (element)
      setAttribute(*element, std::string(parts.attribute), assignment.substr(equals + 1));
  }
}

}  // namespace stroma::view
