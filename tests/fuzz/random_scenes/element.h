// SPDX-License-Identifier: Apache-2.0
// Scenes as text: elements, and how numbers are written in them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/types.h"

namespace stroma::fuzz {

struct Element {
  std::string type;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Element> children;

  // The attribute gets the value, whether or not it has one.
  Element& set(const std::string& name, const std::string& value);
  [[nodiscard]] bool has(const std::string& name) const;
};

[[nodiscard]] std::string textOf(const Element& element, std::size_t indent = 0);

// Six significant digits: short texts, and the same on every machine.
[[nodiscard]] std::string textOf(double number);
[[nodiscard]] std::string textOf(const Vec3& vector);
[[nodiscard]] std::string textOf(const std::vector<Vec3>& points);
template <std::size_t n>
[[nodiscard]] std::string textOf(const std::vector<std::array<Index, n>>& elements) {
  std::string text;
  for (const auto& element : elements) {
    for (const Index node : element) text += (text.empty() ? "" : " ") + std::to_string(node);
  }
  return text;
}

}  // namespace stroma::fuzz
