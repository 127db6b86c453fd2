// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/random_value.h"

#include <algorithm>

#include "tests/fuzz/random_scenes/element.h"

namespace stroma::fuzz {
namespace {

bool startsWith(const std::string& text, std::string_view begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

// Whether the type is made of numbers, so that its ends mean something.
bool isNumeric(const std::string& type) {
  return startsWith(type, "number") || startsWith(type, "whole") || type == "3 numbers" ||
         type == "list of 3 numbers each";
}

// Numbers in one value of the type.
int width(const std::string& type) {
  return type == "3 numbers" || type == "list of 3 numbers each" ? 3 : 1;
}

std::string repeated(const std::string& word, int count) {
  std::string text = word;
  for (int i = 1; i < count; ++i) text += " " + word;
  return text;
}

}  // namespace

std::string_view nameOf(Manner manner) {
  constexpr std::array<std::string_view, 3> names = {"sensible", "extreme", "broken"};
  return names[static_cast<std::size_t>(manner)];
}

std::string RandomValue::of(const AttributeBase& attribute, const Proportions& body) {
  if (manner_ == Manner::broken && dice_.chance(0.04)) return beyond(attribute);
  if (manner_ != Manner::sensible && dice_.chance(0.12) && isNumeric(attribute.typeName())) {
    return atTheEnds(attribute);
  }
  return sensible(attribute, body);
}

std::string RandomValue::sensible(const AttributeBase& attribute, const Proportions& body) {
  const std::string type = attribute.typeName();
  const AttributeInfo& info = attribute.info();
  const std::vector<std::string> choices = attribute.choices();
  if (!choices.empty()) return dice_.oneOf(choices);
  if (type == "true or false") return dice_.oneOf({"true", "false"});
  if (type == "whole number") return wholeNumber(info);
  if (type == "number") return textOf(number(info, body));
  if (type == "3 numbers") return numbers(info, body, 3);
  if (type == "numbers") return numbers(info, body, body.entries);
  if (type == "list of 3 numbers each") return numbers(info, body, 3 * body.entries);
  if (startsWith(type, "rotation")) {
    return textOf(dice_.vector(-1, 1)) + " " + textOf(dice_.uniform(0.1, 1));
  }
  if (startsWith(type, "box")) {
    const Vec3 low = dice_.vector(-0.2, 0.6) * body.length;
    const Vec3 size = dice_.vector(0.05, 0.8) * body.length;
    return textOf(low) + " " + textOf(Vec3(low + size));
  }
  if (type == "colour") return dice_.oneOf({"red", "#08f", "0.1 0.2 0.3"});
  if (type == "indices") return nodes(body, dice_.whole(1, 1 + body.particles / 3));
  if (startsWith(type, "whole") || type.find("whole numbers") != std::string::npos) {
    std::string text = wholeNumber(info);
    const int more = type == "whole numbers" ? body.entries - 1 : type.front() - '1';
    for (int i = 0; i < more; ++i) text += " " + wholeNumber(info);
    return text;
  }
  if (const auto at = type.find(" indices each"); at != std::string::npos) {
    return nodes(body, body.entries * (type[at - 1] - '0'));
  }
  return dice_.oneOf({"one", "two words", "../outside", "a.b"});  // texts, names, files
}

// Counts cost: what has no upper end stays near the lower one.
std::string RandomValue::wholeNumber(const AttributeInfo& info) {
  const int low = std::isfinite(info.min) ? static_cast<int>(info.min) : 0;
  const int high = static_cast<int>(std::min(info.max, low + 20.0));
  return std::to_string(dice_.whole(low, std::max(low, high)));
}

// Within the range; where both ends are known one time in three near one of them.
double RandomValue::number(const AttributeInfo& info, const Proportions& body) {
  const bool low = std::isfinite(info.min), high = std::isfinite(info.max);
  if (low && high) {
    const double part = dice_.chance(1.0 / 3) ? 1 - dice_.decades(1e-4, 0.1) : dice_.uniform(0, 1);
    return info.min + (info.max - info.min) * (dice_.chance(0.8) ? part : 1 - part);
  }
  const double value = ofUnit(info.unit, body);
  if (low) return std::max(value, info.min + (info.exclusiveMin ? 1e-3 * value : 0));
  return dice_.chance(0.3) ? -value : value;
}

double RandomValue::ofUnit(std::string_view unit, const Proportions& body) {
  const double size = body.length, area = size * size;
  if (unit == "m") return size * dice_.decades(1e-3, 2);
  if (unit == "s") return body.dt * dice_.decades(0.5, 30);
  if (unit == "m/s") return dice_.decades(1e-3, 10);
  if (unit == "Pa") return dice_.decades(1e2, 1e8);
  if (unit == "Pa/m") return dice_.decades(1e2, 1e6) / size;
  if (unit == "kg/m^3") return dice_.decades(100, 1e4);
  if (unit == "kg") return 1000 * area * size * dice_.decades(0.1, 10);
  if (unit == "N") return area * dice_.decades(0.1, 1e5);
  if (unit == "N/m") return size * dice_.decades(10, 1e6);
  if (unit == "N s/m" || unit == "kg/s" || unit == "N s") return size * dice_.decades(1e-2, 1e3);
  if (unit == "m^3") return area * size / body.particles * dice_.decades(0.3, 3);
  if (unit == "Hz") return dice_.decades(0.1, 10) / body.dt;
  if (unit == "1/s" || unit == "rad/s") return dice_.decades(1e-2, 1e2);
  if (unit == "rad/m") return dice_.decades(1e-2, 3) / size;
  if (unit == "deg") return dice_.uniform(0, 360);
  return dice_.chance(0.5) ? dice_.uniform(0, 2) : dice_.decades(1e-6, 10);
}

// Times rise.
std::string RandomValue::numbers(const AttributeInfo& info, const Proportions& body, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(number(info, body));
  if (info.unit == "s") std::ranges::sort(values);
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + textOf(value);
  return text;
}

std::string RandomValue::nodes(const Proportions& body, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += (text.empty() ? "" : " ") + std::to_string(dice_.whole(0, body.particles - 1));
  }
  return text;
}

// Allowed, and as far out as can be.
std::string RandomValue::atTheEnds(const AttributeBase& attribute) {
  const AttributeInfo& info = attribute.info();
  const std::string type = attribute.typeName();
  const int count = width(type);
  if (startsWith(type, "whole")) {
    return std::to_string(std::isfinite(info.min) ? static_cast<int>(info.min) : 0);
  }
  std::vector<std::string> ends;
  if (std::isfinite(info.min)) {
    ends.push_back(info.exclusiveMin ? textOf(info.min + 1e-9) : textOf(info.min));
  } else {
    ends.insert(ends.end(), {"-1e9", "-1e-12"});
  }
  if (std::isfinite(info.max)) {
    ends.push_back(info.exclusiveMax ? std::to_string(info.max - 1e-6) : textOf(info.max));
  } else {
    ends.insert(ends.end(), {"1e-30", "1e-12", "1e9", "1e30", "1e300"});
  }
  return repeated(dice_.oneOf(ends), count);
}

// Out of range, or no value at all.
std::string RandomValue::beyond(const AttributeBase& attribute) {
  const AttributeInfo& info = attribute.info();
  std::vector<std::string> texts = {"",
                                    "nan",
                                    "-inf",
                                    "1e999",
                                    "1 2 3 4 5 6 7",
                                    "none\u00e9",
                                    "-1",
                                    "99999999999999999999",
                                    "@/body/nobody.nothing",
                                    "3 parsec"};
  if (std::isfinite(info.min)) texts.push_back(textOf(info.min - 1));
  if (info.exclusiveMin) texts.push_back(textOf(info.min));
  if (std::isfinite(info.max)) texts.push_back(textOf(info.max + 1));
  if (info.exclusiveMax) texts.push_back(textOf(info.max));
  return dice_.oneOf(texts);
}

}  // namespace stroma::fuzz
