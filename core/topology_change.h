// SPDX-License-Identifier: Apache-2.0
// What a cut, or anything else that divides a body, changes in one step: one merged change for each
// body, which every component follows that keeps nodes, triangles or links of it
// (Component::topologyChanged). Ids never move: a changed triangle keeps its slot, everything else
// is appended. Positions are rest positions (m).
#pragma once

#include <string>
#include <vector>

#include "core/types.h"

namespace stroma {

class MechanicalState;
class Topology;

struct NewSurfaceNode {
  Vec3 rest = Vec3::Zero();
  Index copyOf = -1;        // the node it was separated from; a copy lies exactly on it
  Edge parents = {-1, -1};  // ends of the split edge; both -1 for a node that was inside the solid
  double weight = 0.0;      // rest = (1 - weight) * parents[0] + weight * parents[1]
};

struct ChangedTriangle {
  Index slot = -1;
  Triangle nodes = {-1, -1, -1};
};

struct AppendedTriangle {
  Triangle nodes = {-1, -1, -1};
  Index parent = -1;  // the slot it was split off, or -1 for a new wall
  bool wall = false;  // side of an incision
};

// A surface node and a point just inside the part of the body it belongs to. What a node may be
// linked to is tested from that point: copies on a seam lie on the cut itself, and each must see
// its own side only.
struct TouchedNode {
  Index node = -1;
  Vec3 inward = Vec3::Zero();
};

using RestTriangle = std::array<Vec3, 3>;

struct SurfaceEdit {
  Index firstNewNode = 0;
  Index firstNewTriangle = 0;
  std::vector<NewSurfaceNode> nodes;
  std::vector<ChangedTriangle> changed;    // slots below firstNewTriangle, ascending
  std::vector<AppendedTriangle> appended;  // slots from firstNewTriangle on
  std::vector<TouchedNode> touched;        // of all changed and appended triangles, ascending
  std::vector<Index> retired;              // nodes that no triangle uses any more (two that met)
  std::vector<RestTriangle> cutFacets;     // what blocks links from now on
  [[nodiscard]] bool empty() const {
    return nodes.empty() && changed.empty() && appended.empty() && cutFacets.empty();
  }
};

// All cuts of a body so far, as what blocks the sight between two of its points at rest.
class CutBarrier {
 public:
  virtual ~CutBarrier() = default;
  // blocked[k] = 1 where a cut lies between `from` and to[k], else 0. Exact; swapping the two ends
  // does not change the answer. Many threads may ask at the same time.
  virtual void block(const Vec3& from, ConstVec3Span to, std::span<char> blocked) const = 0;
};

// By how much a change of links has changed the energy that the force fields of a body store.
struct LinkEnergy {
  double added = 0;              // J, at the positions of the moment
  std::vector<Index> particles;  // whose links have changed, ascending
};

struct TopologyChange {
  MechanicalState& particles;  // of the body; their number and order never change
  MechanicalState& nodes;      // of its surface
  Topology& surface;           // triangles between the nodes
  const SurfaceEdit& edit;
  const CutBarrier& barrier;     // the new facets included
  LinkEnergy* energy = nullptr;  // for force fields to add to; null where nobody asks

  // A list of nodes follows: copies of its members and nodes on edges between two members join.
  void follow(std::vector<Index>& nodes) const;
};

// What components find wrong with what they keep of a body that has been cut.
struct TopologyCheck {
  MechanicalState& particles;
  MechanicalState& nodes;
  Topology& surface;
  const CutBarrier& barrier;
  Index freeChips = 0;  // particles and nodes with too few supports on their own side
  std::vector<std::string> failures;
};

}  // namespace stroma
