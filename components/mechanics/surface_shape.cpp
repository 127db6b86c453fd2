// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/surface_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "components/mechanics/point_tree.h"
#include "components/mechanics/surface_quadrature.h"
#include "core/parallel.h"

namespace stroma {
namespace {

// Shepard weights of the nearest particles; their support reaches a little beyond the last.
void shepardWeights(std::span<const double> squared, Kernel kernel, std::span<double> weights) {
  const double radius = 1.2 * std::sqrt(squared.back());
  double sum = 0;
  for (std::size_t k = 0; k < squared.size(); ++k) {
    weights[k] = radius > 0 ? kernelWeight(kernel, std::sqrt(squared[k]) / radius) : 1;
    sum += weights[k];
  }
  for (double& w : weights) w /= sum;
}

// Sums of weights by particle, cleared row by row.
class RowBuilder {
 public:
  explicit RowBuilder(std::size_t particles) : weight_(particles, 0), used_(particles, false) {}

  void add(Index particle, double weight) {
    if (!used_[particle]) {
      used_[particle] = true;
      touched_.push_back(particle);
    }
    weight_[particle] += weight;
  }
  void flush(std::vector<ShapeEntry>& entries) {
    std::sort(touched_.begin(), touched_.end());
    for (const Index a : touched_) {
      entries.push_back({a, weight_[a]});
      weight_[a] = 0;
      used_[a] = false;
    }
    touched_.clear();
  }

 private:
  std::vector<double> weight_;
  std::vector<char> used_;
  std::vector<Index> touched_;
};

// Sums of weights by particle for a few particles of many: a hash table with open addressing, of at
// least twice the size of what is added.
class SparseSum {
 public:
  explicit SparseSum(std::size_t most) : slots_(std::bit_ceil(2 * most + 2), {-1, 0}) {}

  void add(Index particle, double weight) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::uint32_t>(particle) * 2654435769U >> 7 & mask;
    while (slots_[at].particle != particle && slots_[at].particle >= 0) at = (at + 1) & mask;
    slots_[at].particle = particle;
    slots_[at].weight += weight;
  }
  // What was added, by ascending particle.
  [[nodiscard]] std::vector<ShapeEntry> sums() const {
    std::vector<ShapeEntry> sums;
    std::ranges::copy_if(slots_, std::back_inserter(sums),
                         [](const ShapeEntry& e) { return e.particle >= 0; });
    std::ranges::sort(sums, {}, &ShapeEntry::particle);
    return sums;
  }

 private:
  std::vector<ShapeEntry> slots_;
};

// One particle's share in a shape function: weight of its position, and the arm along which its
// gradient extrapolates.
struct Share {
  Index carrier;
  double weight;
  Vec3 arm;
};

// Finds the particles that carry a point, and adds up the extrapolations of carriers into rows.
class Extrapolator {
 public:
  Extrapolator(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients, Index supports)
      : X_(X), n_(n), gradients_(gradients), row_(X.size()), weight_(X.size(), 0), arm_(X.size()) {
    if (supports < 1) throw std::invalid_argument("a surface point needs at least one support");
    if (X.empty()) throw std::invalid_argument("no particles to support the surface");
    const bool anyWhole = std::ranges::find(gradients.rank, 3) != gradients.rank.end();
    for (std::size_t i = 0; i < X.size(); ++i)
      if (gradients.rank[i] == 3 || !anyWhole) {
        carriers_.push_back(X[i]);
        id_.push_back(static_cast<Index>(i));
      }
    tree_.emplace(carriers_);
    for (const EllipsoidAxes& a : n.axes)
      longestAxis_ = std::max({longestAxis_, a.tangential, a.across});
    const std::size_t count = std::min(static_cast<std::size_t>(supports), carriers_.size());
    nearest_.resize(count);
    squared_.resize(count);
    weights_.resize(count);
  }

  [[nodiscard]] std::size_t supports() const { return nearest_.size(); }

  // The shares of the particles near a point, supports() of them.
  void find(const Vec3& point, std::span<Share> shares) {
    if (n_.axes.empty())
      tree_->nearest(point, nearest_, squared_);
    else
      nearestInMetric(point);
    shepardWeights(squared_, n_.options.kernel, weights_);
    for (std::size_t k = 0; k < nearest_.size(); ++k) {
      const Index i = id_[nearest_[k]];
      shares[k] = {i, weights_[k], weights_[k] * (point - X_[i])};
    }
  }

  // Adds factor times the shares, their extrapolations going on by `shift`.
  void add(std::span<const Share> shares, double factor, const Vec3& shift) {
    for (const Share& share : shares) {
      if (weight_[share.carrier] == 0) {
        touched_.push_back(share.carrier);
        arm_[share.carrier].setZero();
      }
      weight_[share.carrier] += factor * share.weight;
      arm_[share.carrier] += factor * (share.arm + share.weight * shift);
    }
  }
  // Writes what was added as one row, and who carries it.
  void flush(std::vector<ShapeEntry>& entries, std::vector<Index>& carriers) {
    const auto first = static_cast<std::ptrdiff_t>(carriers.size());
    carriers.insert(carriers.end(), touched_.begin(), touched_.end());
    std::sort(carriers.begin() + first, carriers.end());
    for (const Index i : touched_) {
      double own = weight_[i];
      for (Index slot = n_.rows[i].begin; slot < n_.rows[i].begin + n_.rows[i].size; ++slot) {
        const double part = gradients_.values[slot].dot(arm_[i]);
        row_.add(n_.neighbours[slot], part);
        own -= part;
      }
      row_.add(i, own);
      weight_[i] = 0;
    }
    touched_.clear();
    row_.flush(entries);
  }

 private:
  // By the supports' own metric: among flat cells the nearest particles would be the column below
  // the point, down to the far side of the shell. All that lie nearer than the last of them are
  // among the candidates when these reach as far as the metric's longest axis.
  void nearestInMetric(const Vec3& point) {
    // what was found for a point close by often reaches far enough
    bool found = !wide_.empty() && pickNearest(point);
    for (std::size_t wanted = 4 * nearest_.size(); !found; wanted *= 2) {
      wide_.resize(std::min(wanted, carriers_.size()));
      wideSquared_.resize(wide_.size());
      tree_->nearest(point, wide_, wideSquared_);
      centre_ = point;
      found = pickNearest(point);
    }
    for (std::size_t k = 0; k < nearest_.size(); ++k) {
      nearest_[k] = candidates_[k].second;
      squared_[k] = candidates_[k].first * candidates_[k].first;
    }
  }
  // The nearest in the metric among the particles found around the centre; whether no other
  // particle can be nearer.
  bool pickNearest(const Vec3& point) {
    candidates_.clear();
    for (const Index k : wide_)
      candidates_.emplace_back(n_.distance(id_[k], point - carriers_[k]), k);
    const auto last = candidates_.begin() + static_cast<std::ptrdiff_t>(nearest_.size());
    std::partial_sort(candidates_.begin(), last, candidates_.end());
    const double reach = std::sqrt(wideSquared_.back()) - (point - centre_).norm();
    return wide_.size() == carriers_.size() || (last - 1)->first * longestAxis_ <= reach;
  }

  ConstVec3Span X_;
  const Neighbourhoods& n_;
  const Gradients& gradients_;
  double longestAxis_ = 0;      // of the supports' metric
  Vec3 centre_ = Vec3::Zero();  // of the last search in the tree, and what it found
  std::vector<Index> wide_;
  std::vector<double> wideSquared_;
  std::vector<std::pair<double, Index>> candidates_;
  RowBuilder row_;
  std::vector<double> weight_;  // of the carriers in the row being made
  std::vector<Vec3> arm_;
  std::vector<Index> touched_;
  std::vector<Vec3> carriers_;  // the tree's points
  std::vector<Index> id_;       // and the particles they are
  std::optional<PointTree> tree_;
  std::vector<Index> nearest_;
  std::vector<double> squared_, weights_;
};

// What was appended to the array since the last row ended becomes a row.
template <class T>
void closeRow(std::vector<Row>& rows, const std::vector<T>& entries) {
  const Index begin = rows.empty() ? 0 : rows.back().begin + rows.back().size;
  const Index size = static_cast<Index>(entries.size()) - begin;
  rows.push_back({begin, size, size});
}

}  // namespace

SurfaceShape::SurfaceShape(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients,
                           ConstVec3Span points, Index supports) {
  Extrapolator phi(X, n, gradients, supports);
  std::vector<Share> shares(phi.supports());
  for (const Vec3& s : points) {
    phi.find(s, shares);
    phi.add(shares, 1, Vec3::Zero());
    phi.flush(entries_, carriers_);
    closeRow(rows_, entries_);
    closeRow(carrierRows_, carriers_);
  }
  buildTranspose(static_cast<Index>(X.size()));
}

SurfaceShape SurfaceShape::ofSurface(ConstVec3Span X, const Neighbourhoods& n,
                                     const Gradients& gradients, ConstVec3Span nodes,
                                     std::span<const Triangle> triangles, Index supports,
                                     double maxEdge) {
  const std::vector<SurfaceSample> samples = sampleSurface(nodes, triangles, maxEdge);
  Extrapolator phi(X, n, gradients, supports);
  std::vector<Share> shares((samples.size() + 1) * phi.supports());
  const auto sharesOf = [&](std::size_t sample) {
    return std::span(shares).subspan(sample * phi.supports(), phi.supports());
  };
  struct Part {
    std::size_t sample;
    double area;  // of the sample, that belongs to the node
  };
  std::vector<std::vector<Part>> parts(nodes.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    phi.find(samples[s].position, sharesOf(s));
    for (int corner = 0; corner < 3; ++corner)
      parts[triangles[samples[s].triangle][corner]].push_back(
          {s, samples[s].barycentric[corner] * samples[s].area.norm()});
  }

  SurfaceShape shape;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    double area = 0;
    Vec3 mean = Vec3::Zero();
    for (const Part& part : parts[node]) {
      area += part.area;
      mean += part.area * samples[part.sample].position;
    }
    if (area > 0) {
      const Vec3 shift = nodes[node] - mean / area;
      for (const Part& part : parts[node]) phi.add(sharesOf(part.sample), part.area / area, shift);
    } else {
      phi.find(nodes[node], sharesOf(samples.size()));
      phi.add(sharesOf(samples.size()), 1, Vec3::Zero());
    }
    phi.flush(shape.entries_, shape.carriers_);
    closeRow(shape.rows_, shape.entries_);
    closeRow(shape.carrierRows_, shape.carriers_);
  }
  shape.buildTranspose(static_cast<Index>(X.size()));
  return shape;
}

PointRow SurfaceShape::rowOf(const Vec3& point, std::span<const Carrier> carriers, ConstVec3Span X,
                             const Neighbourhoods& n, const Gradients& gradients) {
  std::vector<double> squared, weights(carriers.size());
  for (const Carrier& c : carriers) squared.push_back(c.squared);
  shepardWeights(squared, n.options.kernel, weights);
  PointRow row;
  std::size_t most = carriers.size();
  for (const Carrier& c : carriers) most += n.neighboursOf(c.particle).size();
  SparseSum sum(most);
  for (std::size_t k = 0; k < carriers.size(); ++k) {
    const Index i = carriers[k].particle;
    const Vec3 arm = weights[k] * (point - X[i]);
    double own = weights[k];
    for (Index slot = n.rows[i].begin; slot < n.rows[i].begin + n.rows[i].size; ++slot) {
      const double part = gradients.values[slot].dot(arm);
      sum.add(n.neighbours[slot], part);
      own -= part;
    }
    sum.add(i, own);
    row.carriers.push_back(i);
  }
  row.entries = sum.sums();
  std::ranges::sort(row.carriers);
  return row;
}

void SurfaceShape::replaceRow(Index s, const PointRow& row) {
  constexpr Index spare = 16;
  if (s == pointCount()) {
    rows_.emplace_back();
    carrierRows_.emplace_back();
  }
  followRow(s, shapeOf(s), row.entries);
  assignRow(rows_[s], entries_, row.entries, spare);
  assignRow(carrierRows_[s], carriers_, row.carriers, Index{0});
}

void SurfaceShape::reserveForCuts() {
  reserveMore(rows_);
  reserveMore(carrierRows_);
  reserveMore(entries_);
  reserveMore(transposed_);
  reserveMore(carriers_);
}

// Both rows ascend: entries of both change their weight, of one only go or come.
void SurfaceShape::followRow(Index s, std::span<const ShapeEntry> before,
                             std::span<const ShapeEntry> now) {
  constexpr Index spare = 16;
  const auto placeOf = [&](Index a) {
    const auto row = pointsOn(a);
    return static_cast<Index>(std::ranges::lower_bound(row, s, {}, &PointEntry::point) -
                              row.begin());
  };
  auto old = before.begin();
  auto next = now.begin();
  while (old != before.end() || next != now.end()) {
    const bool goes = next == now.end() || (old != before.end() && old->particle < next->particle);
    const Index a = goes ? old->particle : next->particle;
    const bool had = old != before.end() && old->particle == a;
    Row& row = transposedRows_[a];
    const Index place = placeOf(a);
    if (goes)
      eraseFromRow(row, transposed_, place);
    else if (had)
      transposed_[row.begin + place].weight = next->weight;
    else
      insertInRow(row, transposed_, place, {s, next->weight}, spare);
    old += had;
    next += !goes;
  }
}

void SurfaceShape::buildTranspose(Index particles) {
  transposedRows_.assign(static_cast<std::size_t>(particles), {});
  for (const ShapeEntry& e : entries_) ++transposedRows_[e.particle].capacity;
  Index begin = 0;
  for (Row& row : transposedRows_) {
    row.begin = begin;
    begin += row.capacity;
  }
  transposed_.resize(entries_.size());
  for (Index s = 0; s < pointCount(); ++s)
    for (const ShapeEntry& e : shapeOf(s)) {
      Row& row = transposedRows_[e.particle];
      transposed_[row.begin + row.size++] = {s, e.weight};
    }
}

void SurfaceShape::apply(ConstVec3Span particles, Vec3Span points) const {
  parallelFor(pointCount(), [&](Index s) { points[s] = valuesAt<1>(s, {particles.data()})[0]; });
}

void SurfaceShape::apply(ConstVec3Span first, ConstVec3Span second, Vec3Span firstPoints,
                         Vec3Span secondPoints) const {
  parallelFor(pointCount(), [&](Index s) {
    const auto values = valuesAt<2>(s, {first.data(), second.data()});
    firstPoints[s] = values[0];
    secondPoints[s] = values[1];
  });
}

void SurfaceShape::applyTo(std::span<const Index> some, ConstVec3Span particles,
                           Vec3Span points) const {
  for (const Index s : some) points[s] = valuesAt<1>(s, {particles.data()})[0];
}

void SurfaceShape::addTransposed(ConstVec3Span points, Vec3Span particles) const {
  const auto isLoaded = [](const Vec3& f) { return !f.isZero(0); };
  const auto loaded = std::ranges::count_if(points, isLoaded);
  constexpr Index few = 8;  // a tool or a grip touches few of the points
  if (few * loaded < pointCount()) {
    for (Index s = 0; s < pointCount() && loaded > 0; ++s) {
      if (!isLoaded(points[s])) continue;
      for (const ShapeEntry& e : shapeOf(s)) particles[e.particle] += e.weight * points[s];
    }
    return;
  }
  parallelFor(particleCount(), [&](Index a) {
    Vec3 sum = Vec3::Zero();
    for (const PointEntry& e : pointsOn(a)) sum += e.weight * points[e.point];
    particles[a] += sum;
  });
}

}  // namespace stroma
