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

struct PointEntry {
  Index point;
  double weight;
};

// A particle that carries a point, by its squared distance in the supports' metric.
struct Carrier {
  Index particle;
  double squared;
};

// Shape functions of one point, by ascending particle.
struct PointRow {
  std::vector<ShapeEntry> entries;
  std::vector<Index> carriers;
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

  // What a single point blends of the given carriers, nearest first.
  [[nodiscard]] static PointRow rowOf(const Vec3& point, std::span<const Carrier> carriers,
                                      ConstVec3Span particles, const Neighbourhoods& neighbourhoods,
                                      const Gradients& gradients);
  // Gives point s, or a new one, s = pointCount(), this row. Costs what the rows hold.
  void replaceRow(Index s, const PointRow& row);
  // Room in the arrays, so that a cut hardly ever has to move them.
  void reserveForCuts();

  [[nodiscard]] Index pointCount() const { return static_cast<Index>(rows_.size()); }
  [[nodiscard]] Index particleCount() const { return static_cast<Index>(transposedRows_.size()); }
  // phi_a(s), by ascending particle.
  [[nodiscard]] std::span<const ShapeEntry> shapeOf(Index s) const {
    return {entries_.data() + rows_[s].begin, static_cast<std::size_t>(rows_[s].size)};
  }
  // phi_a(s) by ascending point.
  [[nodiscard]] std::span<const PointEntry> pointsOn(Index a) const {
    return {transposed_.data() + transposedRows_[a].begin,
            static_cast<std::size_t>(transposedRows_[a].size)};
  }
  // The particles whose extrapolations a point blends, ascending.
  [[nodiscard]] std::span<const Index> carriersOf(Index s) const {
    return {carriers_.data() + carrierRows_[s].begin,
            static_cast<std::size_t>(carrierRows_[s].size)};
  }

  // points = sum_a phi_a particles_a: positions, displacements or velocities.
  void apply(ConstVec3Span particles, Vec3Span points) const;
  // Two at once, such as positions and velocities: the rows are read once.
  void apply(ConstVec3Span first, ConstVec3Span second, Vec3Span firstPoints,
             Vec3Span secondPoints) const;
  // One for some points.
  void applyTo(std::span<const Index> some, ConstVec3Span particles, Vec3Span points) const;
  // particles_a += sum_s phi_a(s) points_s: forces.
  void addTransposed(ConstVec3Span points, Vec3Span particles) const;

 private:
  void buildTranspose(Index particles);
  void followRow(Index s, std::span<const ShapeEntry> before, std::span<const ShapeEntry> now);
  // Of N fields at once, each with the bits that it has alone.
  template <std::size_t N>
  [[nodiscard]] std::array<Vec3, N> valuesAt(Index s,
                                             const std::array<const Vec3*, N>& fields) const {
    std::array<Vec3, N> sums;
    sums.fill(Vec3::Zero());
    for (const ShapeEntry& e : shapeOf(s)) {
      for (std::size_t n = 0; n < N; ++n) sums[n] += e.weight * fields[n][e.particle];
    }
    return sums;
  }

  std::vector<Row> rows_, transposedRows_, carrierRows_;
  std::vector<ShapeEntry> entries_;
  std::vector<PointEntry> transposed_;
  std::vector<Index> carriers_;
};

}  // namespace stroma
