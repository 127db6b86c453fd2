// SPDX-License-Identifier: Apache-2.0
// Walking the scene tree, at load and whenever the graph changes (never in a step).
#pragma once

#include <vector>

#include "core/node.h"

namespace stroma {

// Calls visit(node) for the node and everything below it, parents first, in document order.
template <class Visit>
void forEachNode(Node& node, Visit&& visit) {
  visit(node);
  for (const auto& child : node.children()) forEachNode(*child, visit);
}

template <class Visit>
void forEachComponent(Node& node, Visit&& visit) {
  forEachNode(node, [&](Node& n) {
    for (const auto& component : n.components()) visit(*component);
  });
}

// All components of class T in the node and below.
template <class T>
[[nodiscard]] std::vector<T*> collect(Node& node) {
  std::vector<T*> found;
  forEachComponent(node, [&](Component& c) {
    if (auto* t = dynamic_cast<T*>(&c)) found.push_back(t);
  });
  return found;
}

// All components of class T in this node alone.
template <class T>
[[nodiscard]] std::vector<T*> collectHere(const Node& node) {
  std::vector<T*> found;
  for (const auto& c : node.components()) {
    if (auto* t = dynamic_cast<T*>(c.get())) found.push_back(t);
  }
  return found;
}

}  // namespace stroma
