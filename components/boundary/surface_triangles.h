// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/attribute.h"
#include "core/component.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// The triangles that a surface load acts on, with the corners that meet at each loaded node, so
// that loads are gathered node by node.
class SurfaceTriangles {
 public:
  struct Corner {
    Index triangle;  // in triangles()
    int corner;      // 0, 1 or 2
  };

  // The triangles are `given`, else those of the topology; `subset` picks some by their number.
  // Reports what is out of range at the component; false then.
  [[nodiscard]] bool select(Component& component, const MechanicalState& state,
                            const Topology* topology, const Attribute<std::vector<Triangle>>& given,
                            const Attribute<IndexList>& subset);

  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] Index count() const { return static_cast<Index>(triangles_.size()); }
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const Corner> cornersAt(Index node) const {
    const auto k = static_cast<std::size_t>(node);
    return std::span(corners_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
  }
  // Whether every edge has two triangles that run along it in opposite directions.
  [[nodiscard]] bool closed() const { return rim_.empty(); }
  // Nodes on edges that have one triangle only.
  [[nodiscard]] std::span<const Index> rim() const { return rim_; }

 private:
  void gatherCorners();
  void findRim();
  std::vector<Triangle> triangles_;
  std::vector<Index> nodes_, rim_;
  std::vector<std::size_t> begin_;
  std::vector<Corner> corners_;
};

}  // namespace stroma
