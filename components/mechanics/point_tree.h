// SPDX-License-Identifier: Apache-2.0
// k-d tree over a span of points that must outlive it.
#pragma once

#include <nanoflann.hpp>

#include "core/types.h"

namespace stroma {

class PointTree {
 public:
  explicit PointTree(ConstVec3Span points) : cloud_{points}, tree_(3, cloud_, {leafSize}) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  // Nearest points first; returns how many were found (fewer than asked for in a small cloud).
  std::size_t nearest(const Vec3& at, std::span<Index> ids, std::span<double> squared) const {
    nanoflann::KNNResultSet<double, Index> result(ids.size());
    result.init(ids.data(), squared.data());
    tree_.findNeighbors(result, at.data(), nanoflann::SearchParams());
    return result.size();
  }
  void within(const Vec3& at, double radius, std::vector<std::pair<Index, double>>& found) const {
    found.clear();
    tree_.radiusSearch(at.data(), radius * radius, found, nanoflann::SearchParams(0, 0, false));
  }

 private:
  static constexpr std::size_t leafSize = 12;
  struct Cloud {
    ConstVec3Span points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, Index>
      tree_;
};

}  // namespace stroma
