// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stroma::meshes {

void addBand(const Ring& inner, const Ring& outer, std::vector<Triangle>& triangles) {
  const auto in = [&](Index i) { return inner.first + i % inner.count; };
  const auto out = [&](Index j) { return outer.first + j % outer.count; };
  for (Index i = 0, j = 0; i < inner.count || j < outer.count;) {
    const double alongInner = std::abs(turn(inner, i + 1) - turn(outer, j));
    const double alongOuter = std::abs(turn(outer, j + 1) - turn(inner, i));
    if (j == outer.count || (i < inner.count && alongInner < alongOuter)) {
      triangles.push_back({in(i), out(j), in(i + 1)});
      ++i;
    } else {
      triangles.push_back({in(i), out(j), out(j + 1)});
      ++j;
    }
  }
}

void addFan(Index middle, const Ring& ring, std::vector<Triangle>& triangles) {
  for (Index i = 0; i < ring.count; ++i)
    triangles.push_back({middle, ring.first + i, ring.first + (i + 1) % ring.count});
}

std::vector<Ring> makeRings(std::span<const Index> counts, Index first, bool staggered) {
  std::vector<Ring> rings;
  for (const Index count : counts) {
    rings.push_back({first, count, staggered && rings.size() % 2 == 1 ? 0.5 : 0.0});
    first += count;
  }
  return rings;
}

std::vector<Index> shareOut(Index total, std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<Index> shares;
  std::vector<std::pair<double, std::size_t>> remainders;
  Index left = total;
  for (const double w : weights) {
    const double exact = total * w / sum;
    shares.push_back(static_cast<Index>(std::floor(exact)));
    remainders.emplace_back(shares.back() - exact, shares.size() - 1);
    left -= shares.back();
  }
  std::sort(remainders.begin(), remainders.end());
  for (Index k = 0; k < left; ++k) ++shares[remainders[k].second];
  return shares;
}

}  // namespace stroma::meshes
