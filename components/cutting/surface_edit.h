// SPDX-License-Identifier: Apache-2.0
// What one cut has changed on the surface that is shown, collides and carries loads. Ids never
// move: a changed triangle keeps its slot, everything else is appended. Positions are rest
// positions.
#pragma once

#include <vector>

#include "core/types.h"

namespace stroma {

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

// A surface node and a point just inside the part of the solid it belongs to. What a node may be
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

}  // namespace stroma
