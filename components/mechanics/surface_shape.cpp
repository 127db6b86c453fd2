// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/surface_shape.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/mechanics/point_tree.h"
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

}  // namespace

SurfaceShape::SurfaceShape(ConstVec3Span X, const Neighbourhoods& n, const Gradients& gradients,
                           ConstVec3Span points, Index supports) {
  if (supports < 1) throw std::invalid_argument("a surface point needs at least one support");
  if (X.empty()) throw std::invalid_argument("no particles to support the surface");
  std::vector<Vec3> whole;
  std::vector<Index> id;
  for (std::size_t i = 0; i < X.size(); ++i)
    if (gradients.rank[i] == 3) {
      whole.push_back(X[i]);
      id.push_back(static_cast<Index>(i));
    }
  if (whole.empty())
    for (std::size_t i = 0; i < X.size(); ++i) {
      whole.push_back(X[i]);
      id.push_back(static_cast<Index>(i));
    }

  const PointTree tree(whole);
  const std::size_t count = std::min(static_cast<std::size_t>(supports), whole.size());
  std::vector<Index> nearest(count);
  std::vector<double> squared(count), weights(count);
  RowBuilder row(X.size());
  for (const Vec3& s : points) {
    tree.nearest(s, nearest, squared);
    shepardWeights(squared, n.options.kernel, weights);
    for (std::size_t k = 0; k < count; ++k) {
      const Index i = id[nearest[k]];
      const Vec3 arm = weights[k] * (s - X[i]);
      double own = weights[k];
      for (Index slot = n.rows[i].begin; slot < n.rows[i].begin + n.rows[i].size; ++slot) {
        const double part = gradients.values[slot].dot(arm);
        row.add(n.neighbours[slot], part);
        own -= part;
      }
      row.add(i, own);
    }
    row.flush(entries_);
    begin_.push_back(static_cast<Index>(entries_.size()));
  }
  buildTranspose(static_cast<Index>(X.size()));
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
