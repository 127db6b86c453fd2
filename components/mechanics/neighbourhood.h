// SPDX-License-Identifier: Apache-2.0
// Neighbour lists of particles in the reference configuration, with their kernel weights.
//
// Row i lists the particles j != i in the support of i, nearest first. A support is a ball, a box
// (Chebyshev distance) or an ellipsoid with the metric A = I/st + n n^T (1/sn - 1/st) of the
// particle's normal n and of its spacings st along and sn across the tissue. Its size is either a
// radius, or follows from the number of neighbours: the `count` nearest, support radius `reach`
// times the distance of the last. Rows own a capacity, so that cuts can take neighbours out and put
// others in without moving any other row; particle ids never change.
#pragma once

#include <vector>

#include "components/mechanics/kernel.h"
#include "components/mechanics/row_storage.h"

namespace stroma {

enum class SupportShape { ball, box, ellipsoid };

// Axes of an ellipsoidal support: unit normal, particle spacings (m) along and across the layer.
struct EllipsoidAxes {
  Vec3 normal;
  double tangential;
  double across;
};

struct SupportOptions {
  SupportShape shape = SupportShape::ball;
  Kernel kernel = Kernel::mueller2003;
  Index count = 12;    // neighbours a particle; 0: all within `radius`
  double radius = 0;   // m, or in units of the spacings for ellipsoids; used where count is 0
  double reach = 1.2;  // support radius over the distance of the last neighbour; used with count
  Index spare = 0;     // free places kept at the end of every row
};

struct Neighbourhoods {
  std::vector<Row> rows;          // one a particle
  std::vector<Index> neighbours;  // by slot = row.begin + position
  std::vector<double> weights;    // kernel weight, by slot
  std::vector<double> radii;      // support radius, in the support's own metric
  SupportOptions options;
  std::vector<EllipsoidAxes> axes;  // one a particle for ellipsoids, else empty

  [[nodiscard]] Index particleCount() const { return static_cast<Index>(rows.size()); }
  [[nodiscard]] std::span<const Index> neighboursOf(Index i) const {
    return {neighbours.data() + rows[i].begin, static_cast<std::size_t>(rows[i].size)};
  }
  [[nodiscard]] std::span<const double> weightsOf(Index i) const {
    return {weights.data() + rows[i].begin, static_cast<std::size_t>(rows[i].size)};
  }
  // Length of an offset from particle i, in the metric of i's support.
  [[nodiscard]] double distance(Index i, const Vec3& offset) const;
  // Replaces row i; grows its capacity at the end of the storage where it does not fit.
  void assignRow(Index i, std::span<const Index> newNeighbours, std::span<const double> newWeights);
};

// One entry j -> (i, slot): particle i has j as a neighbour, in that slot of i's row.
struct BackLink {
  Index particle = -1;
  Index slot = -1;
};

struct TransposedRows {
  std::vector<Row> rows;
  std::vector<BackLink> links;  // ordered by particle within a row

  [[nodiscard]] std::span<const BackLink> linksOf(Index j) const {
    return {links.data() + rows[j].begin, static_cast<std::size_t>(rows[j].size)};
  }
  // Follows row i of the neighbourhoods, which has been replaced and had these neighbours before.
  void followRow(const Neighbourhoods& neighbourhoods, Index i, std::span<const Index> before);
};

// Throws std::invalid_argument on non-finite positions, fewer axes than particles, or options that
// define no support. A particle with too few others around it gets a short row.
[[nodiscard]] Neighbourhoods findNeighbourhoods(ConstVec3Span positions,
                                                const SupportOptions& options,
                                                std::span<const EllipsoidAxes> axes = {});

// Largest Euclidean length (m) of an offset whose length in the metric of i's support is one.
[[nodiscard]] double metricExtent(const Neighbourhoods& neighbourhoods, Index i);

[[nodiscard]] TransposedRows transpose(const Neighbourhoods& neighbourhoods);

// Permutation that visits the points along a Morton curve: order[k] is the k-th point to store.
// Particles stored in this order keep their neighbours close in memory.
[[nodiscard]] std::vector<Index> spatialOrder(ConstVec3Span positions);

}  // namespace stroma
