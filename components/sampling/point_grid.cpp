// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/point_grid.h"

#include <algorithm>

namespace stroma {

PointGrid::PointGrid(ConstVec3Span points, double binSize) : points_(points.begin(), points.end()) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  origin_ = low;
  const double most = 16.0 * static_cast<double>(points.size()) + 64;
  double count = 0;
  for (;; binSize *= 1.5) {
    binsPerMetre_ = 1 / binSize;
    const Vec3 extent = (high - low) * binsPerMetre_;
    count = (std::floor(extent[0]) + 1) * (std::floor(extent[1]) + 1) * (std::floor(extent[2]) + 1);
    if (count <= most) break;
  }
  for (int d = 0; d < 3; ++d)
    bins_[d] = static_cast<Index>(std::floor((high[d] - low[d]) * binsPerMetre_)) + 1;

  // counting sort
  start_.assign(static_cast<std::size_t>(count) + 1, 0);
  std::vector<std::size_t> bin(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bin[i] = row(binOf(points[i][1], 1), binOf(points[i][2], 2)) + binOf(points[i][0], 0);
    ++start_[bin[i] + 1];
  }
  for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
  entries_.resize(points.size());
  std::vector<Index> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    entries_[next[bin[i]]++] = {points[i], static_cast<Index>(i)};
}

// A point from the first occupied block of bins around p.
Index PointGrid::anyNear(const Vec3& p) const {
  const std::array<Index, 3> at = {binOf(p[0], 0), binOf(p[1], 1), binOf(p[2], 2)};
  for (Index ring = 0;; ring = 2 * ring + 1) {
    std::array<Index, 3> low, high;
    for (int d = 0; d < 3; ++d) {
      low[d] = std::max(at[d] - ring, Index{0});
      high[d] = std::min(at[d] + ring, bins_[d] - 1);
    }
    for (Index k = low[2]; k <= high[2]; ++k)
      for (Index j = low[1]; j <= high[1]; ++j) {
        const Index first = start_[row(j, k) + low[0]];
        if (first < start_[row(j, k) + high[0] + 1]) return entries_[first].index;
      }
  }
}

Index PointGrid::nearest(const Vec3& p, Index guess) const {
  Index best = guess >= 0 ? guess : anyNear(p);
  double bestSquared = (points_[best] - p).squaredNorm();
  // whatever is nearer lies in the bins that the ball up to the guess touches; a hair more, for the
  // rounding of the root
  const double radius = std::sqrt(bestSquared) * (1 + 1e-12);
  std::array<Index, 3> low, high;
  for (int d = 0; d < 3; ++d) {
    low[d] = binOf(p[d] - radius, d);
    high[d] = binOf(p[d] + radius, d);
  }
  for (Index k = low[2]; k <= high[2]; ++k)
    for (Index j = low[1]; j <= high[1]; ++j) {
      const std::size_t r = row(j, k);
      for (Index e = start_[r + low[0]]; e < start_[r + high[0] + 1]; ++e) {
        const double squared = (entries_[e].position - p).squaredNorm();
        if (squared < bestSquared || (squared == bestSquared && entries_[e].index < best)) {
          bestSquared = squared;
          best = entries_[e].index;
        }
      }
    }
  return best;
}

}  // namespace stroma
