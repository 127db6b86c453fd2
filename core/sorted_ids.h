// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "core/types.h"

namespace stroma {

// Makes a list of ids a set: ascending, each once.
inline void sortUnique(std::vector<Index>& ids) {
  std::ranges::sort(ids);
  const auto [repeated, end] = std::ranges::unique(ids);
  ids.erase(repeated, end);
}

}  // namespace stroma
