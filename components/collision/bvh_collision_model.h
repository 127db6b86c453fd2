// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/collision/triangle_tree.h"
#include "core/interfaces/collision_model.h"
#include "core/interfaces/mesh.h"
#include "core/link.h"
#include "core/surface_links.h"
#include "core/topology_change.h"

namespace stroma {

// A triangle surface that tools can touch: a tree of boxes over its triangles, refitted to where
// they are in each step in which a tool is near, never rebuilt. It adds no call to a step: who asks
// it (a contact response) says when. While every tool is far only the surface's own box is formed,
// one pass over its nodes.
//
// Normals come from the triangles as they lie now, never from a file; triangles show their front
// where (b - a) x (c - a) points, which is outside.
class BVHCollisionModel final : public CollisionModel {
 public:
  Link<MechanicalState> mechanicalState{
      this, "state", "Nodes of the surface.", Lookup::nearest, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Where the triangles come from.", Lookup::nearest};

  void bind() override;
  void start() override;
  void reset() override { start(); }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  // The tree follows a cut at a cost proportional to the change, when both the triangles and the
  // state are those of the body's surface.
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void checkTopology(TopologyCheck& check) const override;

  // The box round all nodes now; formed once a step.
  [[nodiscard]] const Bounds& bounds(std::uint64_t step);
  // Fits the tree to the motion from the positions at the last step's follow() to those now. Where
  // the last step had none the surface is taken to have stood still. Once a step; again is free.
  void follow(std::uint64_t step);

  // The rest refers to the last follow().
  [[nodiscard]] NearestTriangle nearest(const Vec3& p, double reach) const;
  // Where a point that moves straight from p0 to p1 first goes in through the moving surface.
  [[nodiscard]] FirstCrossing firstEntry(const Vec3& p0, const Vec3& p1) const;
  // The point nearest to p that can be reached from triangle `from` by going from neighbour to
  // neighbour, always nearer, and never onto a triangle that is turned away from `facing` (unit):
  // how the end of a god-object's leash slides (Zilles and Salisbury 1995). It stays on the side
  // of a thin sheet on which it began.
  [[nodiscard]] NearestTriangle slide(const Vec3& p, Index from, const Vec3& facing) const;
  // Of a triangle that a cut has divided since the follow() before, the piece nearest to p; the
  // triangle itself where none has.
  [[nodiscard]] Index pieceNear(Index triangle, const Vec3& p) const;
  // Nodes of triangles near the ball, ascending.
  void nodesInBall(const Vec3& centre, double radius, std::vector<Index>& nodes);
  // Unit pseudonormals, see SurfaceLinks.
  [[nodiscard]] Vec3 outward(Index triangle, const Vec3& weights) const;
  [[nodiscard]] Vec3 outwardAtNode(Index node) const;
  // A triangle with the node, -1 for none.
  [[nodiscard]] Index triangleAt(Index node) const;

  [[nodiscard]] std::span<const Triangle> triangles() const { return links_.triangles(); }
  [[nodiscard]] ConstVec3Span positions() const { return now_; }
  // Whether it encloses a volume: then the sign of the distance tells inside from outside.
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] double meanEdge() const { return meanEdge_; }  // m, at rest

 private:
  [[nodiscard]] bool checkTriangles();
  void build();
  void measureEdges();
  void appendPositions(const SurfaceEdit& edit);
  void change(Index triangle, const Triangle& nodes);
  [[nodiscard]] TrianglePoint nearestOn(Index triangle, const Vec3& p) const {
    return nearestOnTriangle(
        cornersOf(links_.triangles()[static_cast<std::size_t>(triangle)], now_), p);
  }

  SurfaceLinks links_;
  TriangleTree tree_;
  std::vector<Vec3> before_, now_;  // positions at the last two calls of follow()
  Bounds bounds_;
  std::uint64_t boundsStep_ = 0, followStep_ = 0;  // 0: never
  struct Piece {
    Index of, triangle;
  };
  std::vector<Piece> cutOff_, pieces_;  // since the last follow(), and since the one before
  std::vector<Index> near_;             // scratch
  double meanEdge_ = 0;
  bool closed_ = false, cut_ = false;
};

}  // namespace stroma
