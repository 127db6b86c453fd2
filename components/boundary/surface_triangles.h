// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/attribute.h"
#include "core/component.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"
#include "core/surface_links.h"
#include "core/topology_change.h"

namespace stroma {

// The triangles that a surface load acts on, with the corners that meet at each loaded node, so
// that loads are gathered node by node. When the body is cut, pieces of a loaded triangle are
// loaded; the new walls of an incision carry no load.
class SurfaceTriangles {
 public:
  // The triangles are `given`, else those of the topology; `subset` picks some by their number.
  // Reports what is out of range at the component; false then.
  [[nodiscard]] bool select(Component& component, const MechanicalState& state,
                            const Topology* topology, const Attribute<std::vector<Triangle>>& given,
                            const Attribute<IndexList>& subset);

  // Follows a cut of the surface, at a cost proportional to the change; false when nothing has
  // changed here. Triangles that are not the topology's own cannot follow: the component warns.
  [[nodiscard]] bool follow(Component& component, const TopologyChange& change);
  // Places in nodes() whose corners the last follow() has changed, ascending.
  [[nodiscard]] std::span<const Index> changedNodes() const { return changed_; }
  // Adds what is wrong; see Component::checkTopology.
  void check(const Component& component, TopologyCheck& check) const;
  // Back to what was selected; false when nothing had changed.
  [[nodiscard]] bool restore();

  [[nodiscard]] std::span<const Triangle> triangles() const { return links_.triangles(); }
  [[nodiscard]] Index count() const { return static_cast<Index>(links_.triangles().size()); }
  // Loaded nodes. One that has lost all of its triangles stays, without corners.
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }
  // Calls visit(triangle, corner) for the corners at nodes()[place], ascending.
  template <class Visit>
  void forCorners(Index place, Visit&& visit) const {
    links_.forCorners(nodes_[static_cast<std::size_t>(place)], std::forward<Visit>(visit));
  }
  // As selected, before any cut: whether every edge has two triangles that run along it in opposite
  // directions, and the nodes on edges that have one triangle only.
  [[nodiscard]] bool closed() const { return rim_.empty(); }
  [[nodiscard]] std::span<const Index> rim() const { return rim_; }

 private:
  void findSlots(bool given);
  void build();
  void findRim();
  void change(Index triangle, const Triangle& nodes);
  [[nodiscard]] bool joins(const SurfaceEdit& edit, const AppendedTriangle& triangle) const;

  std::vector<Triangle> selected_;
  std::vector<Index> slots_;  // of the selected triangles in the topology, -1 for none
  const MechanicalState* state_ = nullptr;
  const Topology* topology_ = nullptr;
  SurfaceLinks links_;         // between the loaded triangles, in their own numbers
  std::vector<Index> loaded_;  // of each of the topology's triangles, its own number or -1
  std::vector<Index> nodes_;
  std::vector<Index> placeOf_;  // of each node of the state in nodes_, -1 for none
  std::vector<Index> rim_, changed_;
  bool foreign_ = false;  // some of the triangles are not the topology's
  bool cut_ = false, warned_ = false;
};

}  // namespace stroma
