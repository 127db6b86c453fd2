// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/mending.h"

#include <algorithm>

namespace stroma::fuzz {
namespace {

// The element with this name, and the list that it is in.
struct Found {
  std::vector<Element>* siblings = nullptr;
  std::size_t index = 0;
  [[nodiscard]] Element& operator*() const { return (*siblings)[index]; }
};

Found find(Element& in, const std::string& name) {
  for (std::size_t i = 0; i < in.children.size(); ++i) {
    for (const auto& [key, value] : in.children[i].attributes) {
      if (key == "name" && value == name) return {&in.children, i};
    }
    const Found below = find(in.children[i], name);
    if (below.siblings) return below;
  }
  return {};
}

// What stands in single quotes.
std::vector<std::string> quotedWords(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find('\''); at != std::string::npos;) {
    const std::size_t end = text.find('\'', at + 1);
    if (end == std::string::npos) break;
    words.push_back(text.substr(at + 1, end - at - 1));
    at = text.find('\'', end + 1);
  }
  return words;
}

void pathsOf(const Element& element, const std::string& node, const Catalogue& catalogue,
             LinkBase& link, std::vector<std::string>& fitting) {
  for (const Element& child : element.children) {
    std::string path = node;
    for (const auto& [key, value] : child.attributes) {
      if (key == "name") path += "/" + value;
    }
    const Kind* kind = catalogue.find(child.type);
    if (kind && link.accepts(*kind->prototype)) fitting.push_back(path);
    pathsOf(child, path, catalogue, link, fitting);
  }
}

}  // namespace

SceneOptions optionsOf(const TrialFolders& folders) {
  SceneOptions options;
  options.pluginFolders = {folders.modules};
  options.dataFolders = {folders.meshes};
  options.writesOutput = false;
  return options;
}

// Every element is written on a line of its own.
Mending::Place Mending::placeOf(const Diagnostic& diagnostic) {
  if (!diagnostic.where.source) return {};
  const SourceText& source = *diagnostic.where.source;
  const auto position = source.position(diagnostic.where.offset);
  const std::string line(source.line(position.line));
  Place place;
  for (std::size_t at = line.find("=\""); at != std::string::npos;) {
    const std::size_t begin = line.rfind(' ', at) + 1, end = line.find('"', at + 2);
    const std::string key = line.substr(begin, at - begin);
    if (key == "name") place.element = line.substr(at + 2, end - at - 2);
    const auto column = static_cast<std::size_t>(position.column - 1);
    if (column >= begin && column <= end) place.attribute = key;
    at = line.find("=\"", end);
  }
  return place;
}

bool Mending::give(Element& element, const Kind& kind, const std::vector<std::string>& names) {
  std::vector<const AttributeBase*> missing;
  for (const std::string& name : names) {
    const AttributeBase* attribute = kind.prototype->attribute(name);
    if (attribute && !element.has(std::string(attribute->name()))) missing.push_back(attribute);
  }
  if (missing.empty()) return false;
  const AttributeBase& attribute = *dice_.oneOf(missing);
  const bool chooses = attribute.typeName() == "indices" && dice_.chance(0.7);
  element.set(std::string(attribute.name()),
              chooses ? "@/body/region.indices"
                      : RandomValue(dice_, Manner::sensible).of(attribute, body_));
  return true;
}

bool Mending::link(Element& root, Element& element, const Kind& kind,
                   const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    LinkBase* wanted = kind.prototype->link(name);
    if (!wanted || element.has(std::string(wanted->name()))) continue;
    std::vector<std::string> fitting;
    pathsOf(root, "", catalogue_, *wanted, fitting);
    if (fitting.empty()) return false;
    element.set(std::string(wanted->name()), "@" + dice_.oneOf(fitting));
    return true;
  }
  return false;
}

bool Mending::follow(Element& root, const Diagnostic& diagnostic) {
  const Place place = placeOf(diagnostic);
  const Found found = find(root, place.element);
  if (!found.siblings) return false;
  Element& element = *found;
  const Kind* kind = catalogue_.find(element.type);
  if (!kind) return false;
  const std::vector<std::string> words = quotedWords(diagnostic.message + " " + diagnostic.hint);
  if (diagnostic.id == "attr-required" && give(element, *kind, words)) return true;
  if (diagnostic.id.compare(0, 5, "link-") == 0 && link(root, element, *kind, words)) return true;
  const auto erased = std::erase_if(element.attributes, [&](const auto& attribute) {
    return attribute.first == place.attribute && attribute.first != "name";
  });
  if (erased == 0)
    found.siblings->erase(found.siblings->begin() + static_cast<std::ptrdiff_t>(found.index));
  return true;
}

void Mending::mend(Element& root, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const std::string text = textOf(root);
    before_(text);
    Scene scene(optionsOf(folders_));
    if (scene.loadText(text, "random_scene.xml") && scene.initialise()) return;
    bool helped = false;
    for (const Diagnostic& d : scene.diagnostics().all()) {
      if (d.severity == Severity::error) helped |= follow(root, d);
    }
    if (!helped) return;
  }
}

}  // namespace stroma::fuzz
