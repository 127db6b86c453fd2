// SPDX-License-Identifier: Apache-2.0
// Lists of numbers in text, with units: what the numeric types of value.h are read from.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/value.h"

namespace stroma {

inline constexpr std::size_t anyCount = static_cast<std::size_t>(-1);

[[nodiscard]] constexpr bool isBlank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');  // tab, line feed, vertical tab, form feed, return
}
// First offset from `begin` on that is not blank, or the size.
[[nodiscard]] std::size_t skipBlanks(std::string_view text, std::size_t begin);
// End of the run of other characters that starts at `begin`.
[[nodiscard]] std::size_t tokenEnd(std::string_view text, std::size_t begin);
// The text without the blanks round it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// An error that points at the token that starts at `begin`.
[[nodiscard]] ParseError tokenError(std::string_view text, std::size_t begin, std::string id,
                                    std::string message, std::string hint = {});

// Appends the numbers of the text, times their units, to `out`; more than `most` are an error.
[[nodiscard]] std::optional<ParseError> parseNumbers(std::string_view text,
                                                     const ValueContext& context, std::size_t most,
                                                     std::vector<double>& out);

// The same for whole numbers, which have no unit.
[[nodiscard]] std::optional<ParseError> parseWholeNumbers(std::string_view text, std::size_t most,
                                                          std::vector<int>& out);

// Whole numbers that are indices: none is negative.
[[nodiscard]] std::optional<ParseError> parseIndices(std::string_view text, std::size_t most,
                                                     std::vector<Index>& out);

// Indices with ranges; see IndexList. As in SOFA the sign of a step gives the direction, and the
// ends of the range are taken in the order that suits it: "10-1-2" is 1 3 5 7 9.
[[nodiscard]] std::optional<ParseError> parseIndexRanges(std::string_view text,
                                                         std::vector<Index>& out);

}  // namespace stroma
