// SPDX-License-Identifier: Apache-2.0
// One number with a unit of any dimension: "-12.3 mm", "5 %", "2.5e-3".
#pragma once

#include <optional>
#include <string_view>

#include "core/units.h"
#include "core/value.h"

namespace stroma::study {

struct Quantity {
  double value = 0;  // SI
  Dimension dimension;
};

// Bare numbers are SI. `out` is changed only on success; the number is finite.
[[nodiscard]] std::optional<ParseError> parseQuantity(std::string_view text, Quantity& out);

}  // namespace stroma::study
