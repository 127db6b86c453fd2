// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/element.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/xml_text.h"

namespace stroma::fuzz {

Element& Element::set(const std::string& name, const std::string& value) {
  const auto found =
      std::ranges::find(attributes, name, &std::pair<std::string, std::string>::first);
  if (found == attributes.end()) {
    attributes.emplace_back(name, value);
  } else {
    found->second = value;
  }
  return *this;
}

bool Element::has(const std::string& name) const {
  return std::ranges::find(attributes, name, &std::pair<std::string, std::string>::first) !=
         attributes.end();
}

std::string textOf(const Element& element, std::size_t indent) {
  std::string text = std::string(indent, ' ') + "<" + element.type;
  for (const auto& [name, value] : element.attributes) {
    text += " " + name + "=\"" + xmlText(value) + "\"";
  }
  if (element.children.empty()) return text + "/>\n";
  text += ">\n";
  for (const Element& child : element.children) text += textOf(child, indent + 2);
  return text + std::string(indent, ' ') + "</" + element.type + ">\n";
}

std::string textOf(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

std::string textOf(const Vec3& vector) {
  return textOf(vector.x()) + " " + textOf(vector.y()) + " " + textOf(vector.z());
}

std::string textOf(const std::vector<Vec3>& points) {
  std::string text;
  for (const Vec3& point : points) text += (text.empty() ? "" : "  ") + textOf(point);
  return text;
}

}  // namespace stroma::fuzz
