// SPDX-License-Identifier: Apache-2.0
// Random values of attributes, from what their declarations say: type, unit, range and choices.
#pragma once

#include <string>

#include "core/attribute.h"
#include "tests/fuzz/random_scenes/dice.h"

namespace stroma::fuzz {

// How a scene is written: with values that make sense, also with such at the ends of their ranges,
// also with such beyond them and with texts that are no values.
enum class Manner { sensible, extreme, broken };
[[nodiscard]] std::string_view nameOf(Manner manner);

// What makes sense for a quantity depends on the body.
struct Proportions {
  double length = 0.1;  // m, of the body
  double dt = 1e-3;     // s
  int particles = 100;
  int entries = 2;  // of lists: those of one component are mostly of one length
};

class RandomValue {
 public:
  RandomValue(Dice& dice, Manner manner) : dice_(dice), manner_(manner) {}

  // The value's text. Whole numbers that only cost time and memory stay small.
  [[nodiscard]] std::string of(const AttributeBase& attribute, const Proportions& body);

 private:
  [[nodiscard]] std::string sensible(const AttributeBase& attribute, const Proportions& body);
  [[nodiscard]] std::string wholeNumber(const AttributeInfo& info);
  [[nodiscard]] double number(const AttributeInfo& info, const Proportions& body);
  [[nodiscard]] double ofUnit(std::string_view unit, const Proportions& body);
  [[nodiscard]] std::string numbers(const AttributeInfo& info, const Proportions& body, int count);
  [[nodiscard]] std::string nodes(const Proportions& body, int count);
  [[nodiscard]] std::string atTheEnds(const AttributeBase& attribute);
  [[nodiscard]] std::string beyond(const AttributeBase& attribute);

  Dice& dice_;
  Manner manner_;
};

}  // namespace stroma::fuzz
