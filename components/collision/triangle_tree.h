// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "components/collision/triangle_geometry.h"

namespace stroma {

struct Bounds {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vec3& p) { min = min.cwiseMin(p), max = max.cwiseMax(p); }
  void grow(double by) { min.array() -= by, max.array() += by; }
  [[nodiscard]] bool meets(const Bounds& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
};

struct NearestTriangle {
  Index triangle = -1;  // none within reach
  TrianglePoint at;
};

struct FirstCrossing {
  Index triangle = -1;  // none
  Crossing at;
};

// Tree of boxes over triangles, one a leaf, on Bullet's dynamic tree (btDbvt, double precision). A
// box holds its triangle at two times, the beginning and the end of its motion; refit() sets all
// boxes anew, from the leaves up, without a change of the tree. Answers do not depend on how
// the tree came about: among equally near or early triangles the lowest number wins.
class TriangleTree {
 public:
  TriangleTree();
  ~TriangleTree();
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  // Makes the tree from nothing.
  void build(std::span<const Triangle> triangles, ConstVec3Span x);
  // The triangle has changed, is new or gone: its leaf is moved, inserted or removed.
  void change(Index triangle, const Triangle& nodes, ConstVec3Span x);
  // Boxes of the triangles moving from `before` to `now`. `before` may be shorter: nodes that it
  // lacks stood still.
  void refit(std::span<const Triangle> triangles, ConstVec3Span before, ConstVec3Span now);

  // The triangle nearest to p that is not farther than `reach`.
  [[nodiscard]] NearestTriangle nearest(const Vec3& p, double reach,
                                        std::span<const Triangle> triangles, ConstVec3Span x) const;
  // Where a point moving from p0 to p1 first enters the moving surface. To be asked after refit()
  // with the same positions.
  [[nodiscard]] FirstCrossing firstEntry(const Vec3& p0, const Vec3& p1,
                                         std::span<const Triangle> triangles, ConstVec3Span before,
                                         ConstVec3Span now) const;
  // Appends the triangles whose boxes reach into the ball, in no particular order.
  void inBall(const Vec3& centre, double radius, std::vector<Index>& found) const;

  [[nodiscard]] Index leafCount() const;
  // Whether each box holds those below it and its triangle; for tests.
  [[nodiscard]] bool holds(std::span<const Triangle> triangles, ConstVec3Span x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stroma
