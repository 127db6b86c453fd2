// SPDX-License-Identifier: Apache-2.0
// Builds a scene's tree from its elements: creates components (loading their modules), reads
// attributes, resolves links. All problems of a scene are reported in one pass.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/scene.h"
#include "core/scene_text.h"
#include "core/units.h"

namespace stroma {

class SceneReader {
 public:
  explicit SceneReader(Scene& scene) : scene_(scene), diagnostics_(scene.diagnostics_) {}

  // Fills the scene's root from the element, applies the overrides, resolves links.
  void read(const SceneElement& root, const std::vector<std::string>& overrides);

 private:
  struct PendingLink {  // an attribute that takes its value from another, or a whole src="..."
    Component* component;
    AttributeBase* attribute;  // null for src
    std::string text;
    SourceRange at;
  };

  void readNode(const SceneElement& element, Node& node, UnitSystem units);
  void readComponent(const SceneElement& element, Node& node, const UnitSystem& units);
  void readRequiredPlugin(const SceneElement& element);
  void readAttribute(Component& component, const SceneAttribute& attribute,
                     const UnitSystem& units);
  void setValue(AttributeOwner& owner, AttributeBase& attribute, const std::string& text,
                const SourceRange& at, const UnitSystem& units);
  const ComponentEntry* findType(std::string_view tag, const SceneElement& element);
  void checkRequired(const Component& component);
  void override(const std::string& assignment);

  void resolveLinks(Component& component);
  void resolveExplicit(Component& component, LinkBase& link);
  void resolveImplicit(Component& component, LinkBase& link);
  void resolvePending(const PendingLink& pending);
  [[nodiscard]] std::string freeName(const Node& node, const std::string& type);
  void reportRepeatedName(const Node& node, const SceneAttribute& name);
  // All components that could play the role of the link, for messages.
  [[nodiscard]] std::string candidates(const LinkBase& link, const Component& self);
  // Unknown elements and attributes: errors, or warnings in lenient mode.
  void strict(std::string id, std::string message, SourceRange at, std::string hint);

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<PendingLink> pending_;
  std::map<std::pair<const Node*, std::string>, int> named_;  // names given to a type in a node
};

}  // namespace stroma
