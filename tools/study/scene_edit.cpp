// SPDX-License-Identifier: Apache-2.0
#include "tools/study/scene_edit.h"

#include <algorithm>

#include "core/xml_text.h"

namespace stroma::study {

std::string nameOf(const SceneElement& element) {
  const SceneAttribute* name = element.find("name");
  return name ? name->value : element.tag;
}

SceneElement* elementAt(SceneElement& root, std::string_view path) {
  SceneElement* at = &root;
  while (at && path.size() > 1) {
    path.remove_prefix(1);
    const std::string_view step = path.substr(0, path.find('/'));
    const auto child = std::ranges::find(at->children, step, nameOf);
    at = child == at->children.end() ? nullptr : &*child;
    path.remove_prefix(step.size());
  }
  return at;
}

namespace {

struct Place {
  std::vector<SceneElement>* siblings = nullptr;  // null for the root
  SceneElement* element = nullptr;
};

// Reports and returns an empty place when the path names nothing.
Place find(SceneElement& root, const Edit& edit, Diagnostics& diagnostics) {
  Place place{nullptr, &root};
  const std::string& path = edit.target;
  for (std::size_t begin = 1; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string step = path.substr(begin, end - begin);
    std::vector<SceneElement>& children = place.element->children;
    const auto found = std::ranges::find(children, step, nameOf);
    if (found == children.end()) {
      std::vector<std::string> names;
      for (const SceneElement& child : children) names.push_back(nameOf(child));
      std::string hint = didYouMean(step, names);
      if (hint.empty()) {
        for (const std::string& name : names) hint += (hint.empty() ? "it has: " : ", ") + name;
      }
      diagnostics.error("edit-path",
                        "the scene has no " + stroma::quoted(step) + " in " +
                            stroma::quoted(begin > 1 ? path.substr(0, begin - 1) : "/"),
                        edit.targetAt, hint);
      return {};
    }
    place = {&children, &*found};
    begin = end + 1;
  }
  return place;
}

void makeOne(SceneElement& root, const Edit& edit, Diagnostics& diagnostics) {
  if (edit.kind == Edit::Kind::set) return;
  const Place place = find(root, edit, diagnostics);
  if (!place.element) return;
  if (edit.kind == Edit::Kind::insert) {
    auto& children = place.element->children;
    if (place.element->tag != "Node") {
      diagnostics.error("edit-into",
                        stroma::quoted(edit.target) + " is a component: it holds no elements",
                        edit.targetAt);
      return;
    }
    children.insert(children.end(), edit.elements.begin(), edit.elements.end());
  } else if (!place.siblings) {
    diagnostics.error("edit-root", "the root of the scene can only be inserted into", edit.targetAt,
                      "give the method a scene of its own: scene=\"...\"");
  } else {
    const auto at = place.siblings->begin() + (place.element - place.siblings->data());
    const auto after = place.siblings->erase(at);
    if (edit.kind == Edit::Kind::replace) {
      place.siblings->insert(after, edit.elements.begin(), edit.elements.end());
    }
  }
}

void print(const SceneElement& element, const std::string& indent, std::string& out) {
  out += indent + "<" + element.tag;
  for (const SceneAttribute& a : element.attributes) {
    out += " " + a.name + "=\"" + xmlText(a.value) + "\"";
  }
  if (element.children.empty()) {
    out += "/>\n";
    return;
  }
  out += ">\n";
  for (const SceneElement& child : element.children) print(child, indent + "  ", out);
  out += indent + "</" + element.tag + ">\n";
}

}  // namespace

void edit(SceneElement& root, const std::vector<Edit>& edits, Diagnostics& diagnostics) {
  for (const Edit& one : edits) makeOne(root, one, diagnostics);
}

std::string sceneText(const SceneElement& root) {
  std::string out = "<?xml version=\"1.0\"?>\n";
  print(root, "", out);
  return out;
}

}  // namespace stroma::study
