// SPDX-License-Identifier: Apache-2.0
#include "tools/study/quantity.h"

#include <charconv>
#include <cmath>

#include "core/diagnostics.h"
#include "core/number_list.h"

namespace stroma::study {

std::optional<ParseError> parseQuantity(std::string_view text, Quantity& out) {
  const std::size_t begin = skipBlanks(text, 0);
  double number = 0;
  const std::size_t digits = begin + (text.substr(begin).starts_with('+') ? 1 : 0);
  const auto [end, failure] =
      std::from_chars(text.data() + digits, text.data() + text.size(), number);
  if (failure != std::errc{} || !std::isfinite(number)) {
    return tokenError(text, begin, "value-number", "a number is wanted here, such as \"-12.3 mm\"");
  }
  const std::size_t unitAt = skipBlanks(text, static_cast<std::size_t>(end - text.data()));
  const std::string_view unitText = trimmed(text.substr(unitAt));
  const auto unit = unitText.empty() ? Unit{} : parseUnit(unitText);
  if (!unit) {
    return ParseError{unitAt, unitText.size(), "unit-unknown",
                      "unknown unit " + stroma::quoted(unitText), "such as mm, kPa, N, J, ms or %"};
  }
  out = {scaled(number, unit->factor), unit->dimension};
  return std::nullopt;
}

}  // namespace stroma::study
