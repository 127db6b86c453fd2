// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/surface_shape.h"

#include <algorithm>
#include <cmath>
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

// Weighted sums of the first-order extrapolations of the particles near a point.
class Extrapolator {
 public:
  Extrapolator(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients, Index supports)
      : X_(X), n_(n), gradients_(gradients), row_(X.size()) {
    if (supports < 1) throw std::invalid_argument("a surface point needs at least one support");
    if (X.empty()) throw std::invalid_argument("no particles to support the surface");
    const bool anyWhole = std::ranges::find(gradients.rank, 3) != gradients.rank.end();
    for (std::size_t i = 0; i < X.size(); ++i)
      if (gradients.rank[i] == 3 || !anyWhole) {
        carriers_.push_back(X[i]);
        id_.push_back(static_cast<Index>(i));
      }
    tree_.emplace(carriers_);
    const std::size_t count = std::min(static_cast<std::size_t>(supports), carriers_.size());
    nearest_.resize(count);
    squared_.resize(count);
    weights_.resize(count);
  }

  // Adds factor phi(point); from the sum of the points' own extrapolations to `shift` beyond.
  void add(const Vec3& point, double factor, const Vec3& shift = Vec3::Zero()) {
    tree_->nearest(point, nearest_, squared_);
    shepardWeights(squared_, n_.options.kernel, weights_);
    for (std::size_t k = 0; k < nearest_.size(); ++k) {
      const Index i = id_[nearest_[k]];
      const double weight = factor * weights_[k];
      addExtrapolation(i, weight, weight * (point - X_[i]) + weights_[k] * shift);
    }
  }
  void flush(std::vector<ShapeEntry>& entries) { row_.flush(entries); }

 private:
  void addExtrapolation(Index i, double weight, const Vec3& arm) {
    double own = weight;
    for (Index slot = n_.rows[i].begin; slot < n_.rows[i].begin + n_.rows[i].size; ++slot) {
      const double part = gradients_.values[slot].dot(arm);
      row_.add(n_.neighbours[slot], part);
      own -= part;
    }
    row_.add(i, own);
  }

  ConstVec3Span X_;
  const Neighbourhoods& n_;
  const Gradients& gradients_;
  RowBuilder row_;
  std::vector<Vec3> carriers_;  // the tree's points
  std::vector<Index> id_;       // and the particles they are
  std::optional<PointTree> tree_;
  std::vector<Index> nearest_;
  std::vector<double> squared_, weights_;
};

}  // namespace

SurfaceShape::SurfaceShape(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients,
                           ConstVec3Span points, Index supports) {
  Extrapolator phi(X, n, gradients, supports);
  for (const Vec3& s : points) {
    phi.add(s, 1);
    phi.flush(entries_);
    begin_.push_back(static_cast<Index>(entries_.size()));
  }
  buildTranspose(static_cast<Index>(X.size()));
}

SurfaceShape SurfaceShape::ofSurface(ConstVec3Span X, const Neighbourhoods& n,
                                     const Gradients& gradients, ConstVec3Span nodes,
                                     std::span<const Triangle> triangles, Index supports,
                                     double maxEdge) {
  const std::vector<SurfaceSample> samples = sampleSurface(nodes, triangles, maxEdge);
  struct Share {
    std::size_t sample;
    double weight;  // area of the sample that belongs to the node
  };
  std::vector<std::vector<Share>> shares(nodes.size());
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (int corner = 0; corner < 3; ++corner)
      shares[triangles[samples[s].triangle][corner]].push_back(
          {s, samples[s].barycentric[corner] * samples[s].area.norm()});

  SurfaceShape shape;
  Extrapolator phi(X, n, gradients, supports);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    double area = 0;
    Vec3 mean = Vec3::Zero();
    for (const Share& share : shares[node]) {
      area += share.weight;
      mean += share.weight * samples[share.sample].position;
    }
    if (area > 0) {
      const Vec3 shift = nodes[node] - mean / area;
      for (const Share& share : shares[node]) {
        const double part = share.weight / area;
        phi.add(samples[share.sample].position, part, part * shift);
      }
    } else {
      phi.add(nodes[node], 1);
    }
    phi.flush(shape.entries_);
    shape.begin_.push_back(static_cast<Index>(shape.entries_.size()));
  }
  shape.buildTranspose(static_cast<Index>(X.size()));
  return shape;
}

void SurfaceShape::buildTranspose(Index particles) {
  transposedBegin_.assign(static_cast<std::size_t>(particles) + 1, 0);
  for (const ShapeEntry& e : entries_) ++transposedBegin_[e.particle + 1];
  for (Index a = 0; a < particles; ++a) transposedBegin_[a + 1] += transposedBegin_[a];
  transposed_.resize(entries_.size());
  std::vector<Index> at(transposedBegin_.begin(), transposedBegin_.end() - 1);
  for (Index s = 0; s < pointCount(); ++s)
    for (const ShapeEntry& e : shapeOf(s)) transposed_[at[e.particle]++] = {s, e.weight};
}

void SurfaceShape::apply(ConstVec3Span particles, Vec3Span points) const {
  parallelFor(pointCount(), [&](Index s) {
    Vec3 sum = Vec3::Zero();
    for (const ShapeEntry& e : shapeOf(s)) sum += e.weight * particles[e.particle];
    points[s] = sum;
  });
}

void SurfaceShape::addTransposed(ConstVec3Span points, Vec3Span particles) const {
  parallelFor(particleCount(), [&](Index a) {
    Vec3 sum = Vec3::Zero();
    for (Index k = transposedBegin_[a]; k < transposedBegin_[a + 1]; ++k)
      sum += transposed_[k].weight * points[transposed_[k].particle];
    particles[a] += sum;
  });
}

}  // namespace stroma
