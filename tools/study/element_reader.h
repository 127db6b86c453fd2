// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of one element of a study: each is asked for once, and what nobody has asked
// for is unknown.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene_text.h"
#include "core/value.h"
#include "tools/study/quantity.h"

namespace stroma::study {

class ElementReader {
 public:
  ElementReader(const SceneElement& element, Diagnostics& diagnostics)
      : element_(element), diagnostics_(diagnostics) {}
  // Reports the attributes that were not asked for.
  ~ElementReader();
  ElementReader(const ElementReader&) = delete;
  ElementReader& operator=(const ElementReader&) = delete;

  // Null when it is not there.
  const SceneAttribute* find(std::string_view name);
  // The text, "" when it is not there.
  std::string text(std::string_view name);
  // The same, but an error when it is not there or empty.
  std::string required(std::string_view name);
  // Where its value is written, the element's place when it is not there.
  SourceRange placeOf(std::string_view name);
  // Names separated by ';'.
  std::vector<std::string> names(std::string_view name);
  // These leave the value as it is when the attribute is not there or cannot be read.
  bool quantity(std::string_view name, Quantity& value);
  bool fraction(std::string_view name, double& value);                     // "5 %" or "0.05"
  bool time(std::string_view name, double& value, bool bareIsMs = false);  // s, greater than 0
  template <class T>
  bool value(std::string_view name, const ValueContext& context, T& out) {
    const SceneAttribute* a = find(name);
    return a && accept(*a, ValueTraits<T>::parse(a->value, context, out));
  }
  // The number of the choice among the words, the first when it is not there.
  std::size_t choice(std::string_view name, std::span<const std::string_view> words);

  void error(const SourceRange& at, std::string id, std::string message, std::string hint = {});

 private:
  bool accept(const SceneAttribute& attribute, const std::optional<ParseError>& problem);
  const SceneElement& element_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
};

}  // namespace stroma::study
