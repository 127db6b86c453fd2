// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "components/mechanics/point_tree.h"
#include "core/parallel.h"

namespace stroma {
namespace {

struct Candidate {
  double distance;
  Index id;
  bool operator<(const Candidate& other) const {
    return distance < other.distance || (distance == other.distance && id < other.id);
  }
};

// The `count` nearest in i's metric: Euclidean candidates, more of them until none can be missing.
void nearestInMetric(const Neighbourhoods& n, const PointTree& tree, ConstVec3Span X, Index i,
                     std::vector<Index>& ids, std::vector<double>& squared,
                     std::vector<Candidate>& out) {
  const auto count = static_cast<std::size_t>(n.options.count);
  const bool euclidean = n.options.shape == SupportShape::ball;
  for (std::size_t wanted = euclidean ? count + 2 : 2 * count + 2;; wanted *= 2) {
    wanted = std::min(wanted, X.size());
    ids.resize(wanted);
    squared.resize(wanted);
    const std::size_t found = tree.nearest(X[i], ids, squared);
    out.clear();
    for (std::size_t k = 0; k < found; ++k)
      if (ids[k] != i) out.push_back({n.distance(i, X[ids[k]] - X[i]), ids[k]});
    std::sort(out.begin(), out.end());
    if (found == X.size()) break;
    // strictly nearer than anything unseen, so that ties are broken by id and not by the tree
    const double unseen = std::sqrt(squared[found - 1]) / metricExtent(n, i);
    if (out.size() >= count && out[count - 1].distance < unseen) break;
  }
  if (out.size() > count) out.resize(count);
}

void withinRadius(const Neighbourhoods& n, const PointTree& tree, ConstVec3Span X, Index i,
                  std::vector<std::pair<Index, double>>& found, std::vector<Candidate>& out) {
  const double radius = n.options.radius;
  tree.within(X[i], radius * metricExtent(n, i), found);
  out.clear();
  for (const auto& [id, squared] : found) {
    const double d = n.distance(i, X[id] - X[i]);
    if (id != i && d < radius) out.push_back({d, id});
  }
  std::sort(out.begin(), out.end());
}

void requireValid(ConstVec3Span X, const SupportOptions& options,
                  std::span<const EllipsoidAxes> axes) {
  if (options.count <= 0 && !(options.radius > 0))
    throw std::invalid_argument("a support needs a count of neighbours or a radius");
  if (options.count > 0 && !(options.reach > 1))
    throw std::invalid_argument("the reach of a support must be larger than 1");
  if (options.shape == SupportShape::ellipsoid) {
    if (axes.size() != X.size())
      throw std::invalid_argument("ellipsoidal supports need the axes of every particle");
    for (const EllipsoidAxes& a : axes)
      if (!(a.tangential > 0 && a.across > 0 && std::abs(a.normal.squaredNorm() - 1) < 1e-6))
        throw std::invalid_argument("ellipsoid axes need a unit normal and positive spacings");
  }
  for (const Vec3& x : X)
    if (!x.allFinite()) throw std::invalid_argument("a particle position is not finite");
}

// Spreads the low 21 bits so that two free bits follow each.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

}  // namespace

double metricExtent(const Neighbourhoods& n, Index i) {
  switch (n.options.shape) {
    case SupportShape::box:
      return std::sqrt(3.0);
    case SupportShape::ellipsoid:
      return std::max(n.axes[i].tangential, n.axes[i].across);
    case SupportShape::ball:
      break;
  }
  return 1;
}

double Neighbourhoods::distance(Index i, const Vec3& offset) const {
  switch (options.shape) {
    case SupportShape::box:
      return offset.cwiseAbs().maxCoeff();
    case SupportShape::ellipsoid: {
      const EllipsoidAxes& a = axes[i];
      const double across = a.normal.dot(offset);
      const double along = std::max(0.0, offset.squaredNorm() - across * across);
      return std::sqrt(along / (a.tangential * a.tangential) +
                       across * across / (a.across * a.across));
    }
    case SupportShape::ball:
      break;
  }
  return offset.norm();
}

void Neighbourhoods::assignRow(Index i, std::span<const Index> newNeighbours,
                               std::span<const double> newWeights) {
  const auto size = static_cast<Index>(newNeighbours.size());
  Row row = rows[i];
  resizeRow(row, neighbours, size, options.spare);
  resizeRow(rows[i], weights, size, options.spare);
  std::copy(newNeighbours.begin(), newNeighbours.end(), neighbours.begin() + row.begin);
  std::copy(newWeights.begin(), newWeights.end(), weights.begin() + row.begin);
}

void TransposedRows::followRow(const Neighbourhoods& n, Index i, std::span<const Index> before) {
  constexpr Index spare = 6;
  const auto placeOf = [&](Index j) {
    const auto row = linksOf(j);
    const auto at = std::lower_bound(row.begin(), row.end(), i,
                                     [](const BackLink& l, Index id) { return l.particle < id; });
    return static_cast<Index>(at - row.begin());
  };
  for (const Index j : before) eraseFromRow(rows[j], links, placeOf(j));
  for (Index slot = n.rows[i].begin; slot < n.rows[i].begin + n.rows[i].size; ++slot) {
    const Index j = n.neighbours[slot];
    insertInRow(rows[j], links, placeOf(j), {i, slot}, spare);
  }
}

Neighbourhoods findNeighbourhoods(ConstVec3Span X, const SupportOptions& options,
                                  std::span<const EllipsoidAxes> axes) {
  requireValid(X, options, axes);
  Neighbourhoods n;
  n.options = options;
  if (options.shape == SupportShape::ellipsoid) n.axes.assign(axes.begin(), axes.end());
  const auto count = static_cast<Index>(X.size());
  n.rows.resize(X.size());
  n.radii.resize(X.size());
  if (X.empty()) return n;

  // search
  const PointTree tree(X);
  std::vector<std::vector<Candidate>> found(X.size());
  parallelChunks(count, defaultChunk, [&](Index begin, Index end) {
    std::vector<Index> ids;
    std::vector<double> squared;
    std::vector<std::pair<Index, double>> ball;
    for (Index i = begin; i < end; ++i) {
      if (options.count > 0)
        nearestInMetric(n, tree, X, i, ids, squared, found[i]);
      else
        withinRadius(n, tree, X, i, ball, found[i]);
    }
  });

  // lay the rows out and weigh the neighbours
  Index slots = 0;
  for (Index i = 0; i < count; ++i) {
    const auto size = static_cast<Index>(found[i].size());
    n.rows[i] = {slots, size, size + options.spare};
    slots += size + options.spare;
  }
  n.neighbours.assign(static_cast<std::size_t>(slots), -1);
  n.weights.assign(static_cast<std::size_t>(slots), 0);
  parallelFor(count, [&](Index i) {
    const auto& row = found[i];
    n.radii[i] = options.count == 0 ? options.radius
                                    : options.reach * (row.empty() ? 0 : row.back().distance);
    Index slot = n.rows[i].begin;
    for (const Candidate& c : row) {
      n.neighbours[slot] = c.id;
      n.weights[slot++] =
          n.radii[i] > 0 ? kernelWeight(options.kernel, c.distance / n.radii[i]) : 0;
    }
  });
  return n;
}

TransposedRows transpose(const Neighbourhoods& n) {
  TransposedRows t;
  t.rows.resize(n.rows.size());
  for (Index i = 0; i < n.particleCount(); ++i)
    for (const Index j : n.neighboursOf(i)) ++t.rows[j].capacity;
  Index begin = 0;
  for (Row& row : t.rows) {
    row.begin = begin;
    row.capacity += n.options.spare;
    begin += row.capacity;
  }
  t.links.resize(static_cast<std::size_t>(begin), {-1, -1});
  for (Index i = 0; i < n.particleCount(); ++i)
    for (Index k = 0; k < n.rows[i].size; ++k) {
      Row& row = t.rows[n.neighbours[n.rows[i].begin + k]];
      t.links[row.begin + row.size++] = {i, n.rows[i].begin + k};
    }
  return t;
}

std::vector<Index> spatialOrder(ConstVec3Span X) {
  std::vector<Index> order(X.size());
  std::iota(order.begin(), order.end(), 0);
  if (X.empty()) return order;
  Vec3 low = X[0], high = X[0];
  for (const Vec3& x : X) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double cell = std::max((high - low).maxCoeff(), 1e-300) / ((1 << 20) - 1);
  std::vector<std::uint64_t> code(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) {
    const Vec3 c = (X[i] - low) / cell;
    code[i] = spreadBits(static_cast<std::uint64_t>(c.x())) |
              spreadBits(static_cast<std::uint64_t>(c.y())) << 1 |
              spreadBits(static_cast<std::uint64_t>(c.z())) << 2;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&code](Index a, Index b) { return code[a] < code[b]; });
  return order;
}

}  // namespace stroma
