// SPDX-License-Identifier: Apache-2.0
// Items in cubic cells found by hashing, for searches whose cost follows what is found and not what
// is stored. An item may lie in several cells.
#pragma once

#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/types.h"

namespace stroma {

class HashGrid {
 public:
  explicit HashGrid(double cell) : inverse_(1 / cell) {}

  void reserve(std::size_t cells) { cells_.reserve(cells); }
  void insert(Index item, const Vec3& low, const Vec3& high) {
    forCells(low, high, [&](std::uint64_t key) { cells_[key].push_back(item); });
  }
  void insert(Index item, const Vec3& x) { insert(item, x, x); }

  // Calls visit(item) for everything in the cells that the box touches; items in several cells
  // come several times.
  template <class Visit>
  void query(const Vec3& low, const Vec3& high, Visit&& visit) const {
    forCells(low, high, [&](std::uint64_t key) {
      const auto found = cells_.find(key);
      if (found == cells_.end()) return;
      for (const Index item : found->second) visit(item);
    });
  }

 private:
  template <class Function>
  void forCells(const Vec3& low, const Vec3& high, Function&& function) const {
    const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x * inverse_)); };
    for (std::int64_t i = cell(low.x()); i <= cell(high.x()); ++i)
      for (std::int64_t j = cell(low.y()); j <= cell(high.y()); ++j)
        for (std::int64_t k = cell(low.z()); k <= cell(high.z()); ++k) function(key(i, j, k));
  }
  // 21 bits for each direction; cells whose keys agree only cost time
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    constexpr std::uint64_t mask = (1U << 21) - 1;
    return (static_cast<std::uint64_t>(i) & mask) << 42 |
           (static_cast<std::uint64_t>(j) & mask) << 21 | (static_cast<std::uint64_t>(k) & mask);
  }

  double inverse_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

}  // namespace stroma
