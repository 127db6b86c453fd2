// SPDX-License-Identifier: Apache-2.0
// Shape functions of points that ride on particles, such as the nodes of a surface mesh:
//   x_s = sum_i w_si [x_i + F_i (X_s - X_i)] = sum_a phi_a(s) x_a,
// the Shepard blend, over the k nearest particles i of s, of their first-order extrapolations, with
// F_i from the gradients given. The scalars phi_a(s) are kept as sparse rows, so that forces go
// back by the exact transpose. They sum to one and move linear fields exactly. Particles without a
// full gradient support a point only where no other is near.
#pragma once

#include "components/mechanics/gradients.h"

namespace stroma {

struct ShapeEntry {
  Index particle;
  double weight;
};

class SurfaceShape {
 public:
  SurfaceShape() = default;
  // points: reference positions. supports: how many particles carry a point, at least 1.
  SurfaceShape(ConstVec3Span particles, const Neighbourhoods& neighbourhoods,
               const Gradients& gradients, ConstVec3Span points, Index supports = 12);

  // Nodes of a triangle surface. A node's shape function is the mean, over the triangles around it,
  // of those of sample points no further apart than maxEdge (m), weighted by the node's own linear
  // shape function, plus the first-order shift from the samples' mean position to the node. Forces
  // on nodes (pressure times nodal area, say) thus act as tractions spread over the triangles,
  // however coarse these are; nodes without triangles are points as above.
  [[nodiscard]] static SurfaceShape ofSurface(ConstVec3Span particles,
                                              const Neighbourhoods& neighbourhoods,
                                              const Gradients& gradients, ConstVec3Span nodes,
                                              std::span<const Triangle> triangles, Index supports,
                                              double maxEdge);

  [[nodiscard]] Index pointCount() const { return static_cast<Index>(begin_.size()) - 1; }
  [[nodiscard]] Index particleCount() const {
    return static_cast<Index>(transposedBegin_.size()) - 1;
  }
  // phi_a(s), by ascending particle.
  [[nodiscard]] std::span<const ShapeEntry> shapeOf(Index s) const {
    return {entries_.data() + begin_[s], static_cast<std::size_t>(begin_[s + 1] - begin_[s])};
  }

  // points = sum_a phi_a particles_a: positions, displacements or velocities.
  void apply(ConstVec3Span particles, Vec3Span points) const;
  // particles_a += sum_s phi_a(s) points_s: forces.
  void addTransposed(ConstVec3Span points, Vec3Span particles) const;

 private:
  void buildTranspose(Index particles);

  std::vector<Index> begin_{0}, transposedBegin_{0};
  std::vector<ShapeEntry> entries_, transposed_;  // transposed entries name points
};

}  // namespace stroma
