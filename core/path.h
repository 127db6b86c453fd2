// SPDX-License-Identifier: Apache-2.0
// Paths to nodes, components and attributes, as scenes and the command line write them.
//
//   @name  @name.attr  @../a/b.attr  @/from/the/root  @./here  @[-1].attr  @..  @.
//
// A first step without prefix is looked for in the node (child nodes first), then in its ancestors;
// later steps only where they stand. @[-1] is the previous component of the same node.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/node.h"

namespace stroma {

struct PathTarget {
  Node* node = nullptr;
  Component* component = nullptr;  // null when the path ends at a node
  explicit operator bool() const { return node != nullptr; }
};

struct PathParts {
  std::string_view object;     // before the attribute
  std::string_view attribute;  // empty without one
};

// Splits at the last dot behind the last slash; "." and ".." are steps, not attributes.
[[nodiscard]] PathParts splitPath(std::string_view path);

// Finds what `path` (without '@' and attribute) names, seen from a component of `node` (or from the
// node itself when `self` is null). On failure `problem` says why and `hint` names near misses.
[[nodiscard]] PathTarget resolvePath(Node& node, const Component* self, std::string_view path,
                                     std::string& problem, std::string& hint);

// An attribute of a component, or of a node (`component` is then null).
struct AttributeTarget {
  Component* component = nullptr;
  AttributeBase* attribute = nullptr;
  explicit operator bool() const { return attribute != nullptr; }
};

// Finds "/path/to/component.attribute" from the root; likewise.
[[nodiscard]] AttributeTarget findAttribute(Node& root, std::string_view path, std::string& problem,
                                            std::string& hint);

}  // namespace stroma
