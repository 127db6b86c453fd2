// SPDX-License-Identifier: Apache-2.0
// Pieces of text mesh files: lines, words and numbers, without a locale and without a copy.
#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>

namespace stroma {

// Splits off the first line, without its end.
inline std::string_view takeLine(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

// Splits off the first word; empty at the end.
inline std::string_view takeWord(std::string_view& rest, std::string_view blanks = " \t\r") {
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  const std::size_t end = std::min(rest.find_first_of(blanks), rest.size());
  const std::string_view word = rest.substr(0, end);
  rest.remove_prefix(end);
  return word;
}

// The whole word as a number; "nan" and "inf" are numbers here.
template <class Number>
[[nodiscard]] bool readNumber(std::string_view word, Number& out) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), out);
  return failure == std::errc() && end == word.data() + word.size();
}

}  // namespace stroma
