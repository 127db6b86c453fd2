// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/blue_noise.h"

#include <cmath>
#include <queue>
#include <utility>

#include "components/sampling/point_grid.h"

namespace stroma {
namespace {

struct Neighbour {
  Index index;
  double weight;
};

// (1 - d / 2r)^8
double crowding(double squaredDistance, double radius) {
  const double a = 1 - std::min(std::sqrt(squaredDistance) / (2 * radius), 1.0);
  const double a2 = a * a, a4 = a2 * a2;
  return a4 * a4;
}

}  // namespace

std::vector<Index> eliminateSamples(ConstVec3Span candidates, Index count, double radius) {
  const auto total = static_cast<Index>(candidates.size());
  std::vector<Index> start(candidates.size() + 1, 0);
  std::vector<Neighbour> neighbours;
  std::vector<double> weight(candidates.size(), 0);
  if (total > count) {
    const PointGrid grid(candidates, 2 * radius);
    neighbours.reserve(40 * candidates.size());
    for (Index i = 0; i < total; ++i) {
      grid.forEachWithin(candidates[i], 2 * radius, [&](Index j, double squared) {
        if (j == i) return;
        neighbours.push_back({j, crowding(squared, radius)});
        weight[i] += neighbours.back().weight;
      });
      start[i + 1] = static_cast<Index>(neighbours.size());
    }
  }

  // eliminate the most crowded; entries whose weight has sunk since are put back with the new one
  std::priority_queue<std::pair<double, Index>> queue;
  std::vector<bool> kept(candidates.size(), true);
  for (Index i = 0; i < total; ++i) queue.emplace(weight[i], i);
  for (Index left = total; left > count;) {
    const auto [worst, i] = queue.top();
    queue.pop();
    if (worst != weight[i]) {
      queue.emplace(weight[i], i);
      continue;
    }
    kept[i] = false;
    --left;
    for (Index e = start[i]; e < start[i + 1]; ++e)
      weight[neighbours[e].index] -= neighbours[e].weight;
  }
  std::vector<Index> picked;
  for (Index i = 0; i < total; ++i)
    if (kept[i]) picked.push_back(i);
  return picked;
}

}  // namespace stroma
