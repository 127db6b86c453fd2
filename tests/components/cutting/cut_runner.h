// SPDX-License-Identifier: Apache-2.0
// Sweeps blades through bodies and checks everything after every step.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "components/cutting/cut_facets.h"
#include "components/cutting/cut_invariants.h"
#include "components/cutting/cutter.h"

namespace stroma::test {

// Straight blade of twelve points from `top` to `bottom`.
inline std::vector<Vec3> blade(const Vec3& top, const Vec3& bottom) {
  std::vector<Vec3> points;
  for (int k = 0; k < 12; ++k) points.push_back(top + k / 11.0 * (bottom - top));
  return points;
}

// Pose of the blade at s in [0, 1].
using Sweep = std::function<std::vector<Vec3>(double)>;

inline Sweep straight(const Vec3& from, const Vec3& to, const Vec3& top, const Vec3& bottom) {
  return [=](double s) {
    const Vec3 x = from + s * (to - from);
    return blade(x + top, x + bottom);
  };
}

struct Worst {
  double openness = 0, volume = 0, angle = 180, slivers = 0, height = 1;
  Index steps = 0, retired = 0;
  void merge(const Worst& w) {
    openness = std::max(openness, w.openness);
    volume = std::max(volume, w.volume);
    angle = std::min(angle, w.angle);
    slivers = std::max(slivers, w.slivers);
    height = std::min(height, w.height);
    steps += w.steps;
    retired += w.retired;
  }
  void merge(const SurfaceNumbers& n) {
    openness = std::max(openness, n.openness);
    volume = std::max(volume, n.volumeMismatch);
    angle = std::min(angle, n.smallestAngle);
    slivers = std::max(slivers, n.sliverFraction);
    height = std::min(height, n.smallestTriangle);
    ++steps;
  }
};

// A surface kept up to date from the edits alone must stay the complex's own.
class FollowedSurface {
 public:
  explicit FollowedSurface(const SimplicialComplex& complex)
      : complex_(complex),
        positions_(complex.nodePositions()),
        triangles_(complex.surface().begin(), complex.surface().end()) {}
  void apply(const SurfaceEdit& edit) {
    ASSERT_EQ(static_cast<std::size_t>(edit.firstNewNode), positions_.size());
    ASSERT_EQ(static_cast<std::size_t>(edit.firstNewTriangle), triangles_.size());
    for (const NewSurfaceNode& n : edit.nodes) {
      if (n.copyOf >= 0) {
        ASSERT_LT(static_cast<std::size_t>(n.copyOf), positions_.size());
        EXPECT_EQ(positions_[static_cast<std::size_t>(n.copyOf)], n.rest);
      }
      if (n.parents[0] >= 0) {
        const Vec3& a = positions_[static_cast<std::size_t>(n.parents[0])];
        const Vec3& b = positions_[static_cast<std::size_t>(n.parents[1])];
        EXPECT_LE(((1 - n.weight) * a + n.weight * b - n.rest).norm(), 1e-15);
      }
      positions_.push_back(n.rest);
    }
    for (const ChangedTriangle& c : edit.changed)
      triangles_[static_cast<std::size_t>(c.slot)] = c.nodes;
    for (const AppendedTriangle& a : edit.appended) triangles_.push_back(a.nodes);
  }
  void expectSame() const {
    EXPECT_EQ(positions_, complex_.nodePositions());
    EXPECT_TRUE(std::equal(triangles_.begin(), triangles_.end(), complex_.surface().begin(),
                           complex_.surface().end()));
  }

 private:
  const SimplicialComplex& complex_;
  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;
};

// Runs a sweep in `steps` poses; s from `begin` to `end`. Every change is checked.
inline Worst runCut(SimplicialComplex& complex, Cutter& cutter, const Sweep& sweep, int steps,
                    double volume, double begin = 0, double end = 1) {
  Worst worst;
  FollowedSurface followed(complex);
  for (int k = 0; k <= steps + 1; ++k) {
    const SurfaceEdit edit =
        k <= steps ? cutter.advance(sweep(begin + (end - begin) * k / steps)) : cutter.finish();
    if (edit.empty()) continue;
    followed.apply(edit);
    worst.retired += static_cast<Index>(edit.retired.size());
    const SurfaceNumbers n = checkInvariants(complex, volume);
    worst.merge(n);
    for (const std::string& text : n.failures) ADD_FAILURE() << "step " << k << ": " << text;
    if (!n.failures.empty()) return worst;
  }
  followed.expectSame();
  return worst;
}

inline Index pieceCount(const SimplicialComplex& complex) {
  Index count = 0;
  (void)complex.pieces(count);
  return count;
}

}  // namespace stroma::test
