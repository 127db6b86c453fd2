// SPDX-License-Identifier: Apache-2.0
// Names of methods and points, as studies refer to them and as files are called after them.
#pragma once

#include <algorithm>
#include <cctype>
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

// A file's name after a text: lower case, other characters than letters and digits as dashes.
[[nodiscard]] inline std::string slug(std::string_view text) {
  std::string out;
  for (const unsigned char c : text) {
    if (std::isalnum(c) && c < 128) {
      out += static_cast<char>(std::tolower(c));
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  out.resize(std::min<std::size_t>(out.size(), 70));
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out;
}

}  // namespace stroma::study
