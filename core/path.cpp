// SPDX-License-Identifier: Apache-2.0
#include "core/path.h"

#include <algorithm>
#include <charconv>

#include "core/diagnostics.h"
#include "core/traverse.h"

namespace stroma {
namespace {

PathTarget lookHere(Node& node, std::string_view name) {
  for (const auto& child : node.children()) {
    if (child->name() == name) return {child.get(), nullptr};
  }
  for (const auto& component : node.components()) {
    if (component->name() == name) return {&node, component.get()};
  }
  return {};
}

std::vector<std::string> namesHere(const Node& node) {
  std::vector<std::string> names;
  for (const auto& child : node.children()) names.push_back(child->name());
  for (const auto& component : node.components()) names.push_back(component->name());
  return names;
}

Node& rootOf(Node& node) {
  Node* n = &node;
  while (n->parent()) n = n->parent();
  return *n;
}

PathTarget previous(Node& node, const Component* self, std::string_view index,
                    std::string& problem) {
  int back = 0;
  const auto parsed = std::from_chars(index.data(), index.data() + index.size(), back);
  if (parsed.ec != std::errc() || parsed.ptr != index.data() + index.size() || back >= 0) {
    problem = "'[" + std::string(index) + "]' is not a negative number in brackets";
    return {};
  }
  const auto& all = node.components();
  const auto own = std::ranges::find(all, self, [](const auto& c) { return c.get(); });
  const auto position = own - all.begin() + back;
  if (own == all.end() || position < 0) {
    problem = "there are not " + std::to_string(-back) + " components before this one";
    return {};
  }
  return {&node, all[static_cast<std::size_t>(position)].get()};
}

}  // namespace

PathParts splitPath(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t tailAt = slash == std::string_view::npos ? 0 : slash + 1;
  const std::string_view tail = path.substr(tailAt);
  if (tail == "." || tail == "..") return {path, {}};
  const std::size_t dot = tail.rfind('.');
  if (dot == std::string_view::npos) return {path, {}};
  // "...attr" after "..": the dots of the step belong to the step
  return {path.substr(0, tailAt + dot), tail.substr(dot + 1)};
}

PathTarget resolvePath(Node& from, const Component* self, std::string_view path,
                       std::string& problem, std::string& hint) {
  if (path.size() > 1 && path.front() == '[' && path.back() == ']') {
    return previous(from, self, path.substr(1, path.size() - 2), problem);
  }
  PathTarget at{&from, nullptr};
  bool searchUp = true;
  if (path.starts_with('/')) {
    at.node = &rootOf(from);
    path.remove_prefix(1);
    searchUp = false;
  }
  while (!path.empty()) {
    const std::size_t end = path.find('/');
    const std::string_view step = path.substr(0, end);
    path.remove_prefix(end == std::string_view::npos ? path.size() : end + 1);
    if (at.component) {
      problem = "'" + at.component->name() + "' is a component: nothing lies below it";
      return {};
    }
    if (step.empty() || step == ".") {
      searchUp = false;
      continue;
    }
    if (step == "..") {
      if (!at.node->parent()) {
        problem = "the path leads above the root";
        return {};
      }
      at.node = at.node->parent();
      searchUp = false;
      continue;
    }
    PathTarget next;
    for (Node* n = at.node; n && !next; n = searchUp ? n->parent() : nullptr) {
      next = lookHere(*n, step);
    }
    if (!next) {
      problem = "there is no '" + std::string(step) + "' in " +
                (searchUp ? at.node->path() + " or above it" : at.node->path());
      std::vector<std::string> names;
      for (Node* n = at.node; n; n = searchUp ? n->parent() : nullptr) {
        const auto here = namesHere(*n);
        names.insert(names.end(), here.begin(), here.end());
      }
      hint = didYouMean(step, names);
      return {};
    }
    at = next;
    searchUp = false;
  }
  return at;
}

AttributeTarget findAttribute(Node& root, std::string_view path, std::string& problem,
                              std::string& hint) {
  const PathParts parts = splitPath(path);
  const PathTarget target = resolvePath(root, nullptr, parts.object, problem, hint);
  if (!target) return {};
  AttributeOwner& owner =
      target.component ? static_cast<AttributeOwner&>(*target.component) : *target.node;
  AttributeBase* attribute = owner.attribute(parts.attribute);
  if (!attribute) {
    problem = owner.describe() + " has no attribute " + stroma::quoted(parts.attribute);
    std::vector<std::string> names;
    for (const AttributeBase* a : owner.attributes()) names.emplace_back(a->name());
    hint = didYouMean(parts.attribute, names);
  }
  return {target.component, attribute};
}

}  // namespace stroma
