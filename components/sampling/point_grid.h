// SPDX-License-Identifier: Apache-2.0
// Points sorted into the bins of a regular grid, for nearest-point and fixed-radius queries by the
// million. With bins of about the points' spacing a nearest query looks at a dozen points. Answers
// do not depend on the bin size: of two equally near points the one of lower index is nearest.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/types.h"

namespace stroma {

class PointGrid {
 public:
  // At least one point, all finite; `binSize` (m) > 0 is enlarged where the bins would outnumber
  // the points too much.
  PointGrid(ConstVec3Span points, double binSize);

  // Index of the point nearest to `p`. `guess`, the index of a point that is near already, makes
  // the query fast; without one the search starts from p's bin.
  [[nodiscard]] Index nearest(const Vec3& p, Index guess = -1) const;

  // Calls visit(index, squaredDistance) for all points within `radius` of `p`, in an order that is
  // fixed by the grid.
  template <class Visit>
  void forEachWithin(const Vec3& p, double radius, Visit&& visit) const;

 private:
  struct Entry {
    Vec3 position;
    Index index;
  };

  [[nodiscard]] Index anyNear(const Vec3& p) const;
  [[nodiscard]] Index binOf(double coordinate, int axis) const;
  [[nodiscard]] std::size_t row(Index j, Index k) const {
    return static_cast<std::size_t>(bins_[0]) * (j + static_cast<std::size_t>(bins_[1]) * k);
  }

  Vec3 origin_;
  double binsPerMetre_;
  std::array<Index, 3> bins_;
  std::vector<Vec3> points_;
  std::vector<Index> start_;    // per bin, x fastest: first entry
  std::vector<Entry> entries_;  // sorted by bin, then by index
};

inline Index PointGrid::binOf(double coordinate, int axis) const {
  const double bin = (coordinate - origin_[axis]) * binsPerMetre_;
  return static_cast<Index>(std::min(std::max(bin, 0.0), bins_[axis] - 1.0));
}

template <class Visit>
void PointGrid::forEachWithin(const Vec3& p, double radius, Visit&& visit) const {
  std::array<Index, 3> low, high;
  for (int d = 0; d < 3; ++d) {
    low[d] = binOf(p[d] - radius, d);
    high[d] = binOf(p[d] + radius, d);
  }
  for (Index k = low[2]; k <= high[2]; ++k)
    for (Index j = low[1]; j <= high[1]; ++j)
      for (Index e = start_[row(j, k) + low[0]]; e < start_[row(j, k) + high[0] + 1]; ++e) {
        const double squared = (entries_[e].position - p).squaredNorm();
        if (squared <= radius * radius) visit(entries_[e].index, squared);
      }
}

}  // namespace stroma
