// SPDX-License-Identifier: Apache-2.0
// Names of methods and points, as studies refer to them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace stroma::study {

using Names = std::vector<std::string>;

// Whether a name is the one wanted, or begins as it does where that ends with '*'.
[[nodiscard]] inline bool fits(std::string_view wanted, std::string_view name) {
  return wanted.ends_with('*') ? name.starts_with(wanted.substr(0, wanted.size() - 1))
                               : name == wanted;
}

// Whether what is wanted fits any of the names.
[[nodiscard]] inline bool isAmong(std::string_view wanted, const Names& names) {
  return std::ranges::any_of(names, [&](const std::string& name) { return fits(wanted, name); });
}

// Whether the name fits any of what is wanted.
[[nodiscard]] inline bool fitsAny(std::string_view name, const Names& wanted) {
  return std::ranges::any_of(wanted, [&](const std::string& one) { return fits(one, name); });
}

}  // namespace stroma::study
