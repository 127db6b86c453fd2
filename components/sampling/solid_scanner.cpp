// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/solid_scanner.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace stroma {
namespace {

// Twice the signed area of (a, b, point) in the yz plane.
double orient(const Vec3& a, const Vec3& b, double y, double z) {
  return (b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1]);
}

// Its sign, decided from the same arithmetic for both directions of the edge; a point on the edge's
// line is moved by (e, e^2), e infinitesimal.
int side(ConstVec3Span x, Index from, Index to, double y, double z) {
  const bool swapped = from > to;
  const Vec3& a = x[swapped ? to : from];
  const Vec3& b = x[swapped ? from : to];
  double value = orient(a, b, y, z);
  if (value == 0) value = a[2] - b[2];
  if (value == 0) value = b[1] - a[1];
  const int sign = value > 0 ? 1 : value < 0 ? -1 : 0;
  return swapped ? -sign : sign;
}

}  // namespace

SolidScanner::SolidScanner(ConstVec3Span positions, TriangleSpan triangles)
    : mesh_{{positions.begin(), positions.end()}, {triangles.begin(), triangles.end()}} {
  low_ = high_ = mesh_.positions.front();
  for (const Vec3& p : mesh_.positions) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  buildBins();
}

Index SolidScanner::binOf(double coordinate, int axis) const {
  const double bin = std::floor((coordinate - low_[axis + 1]) / binSize_[axis]);
  return static_cast<Index>(std::min(std::max(bin, 0.0), bins_[axis] - 1.0));
}

void SolidScanner::buildBins() {
  const double side = std::sqrt(static_cast<double>(mesh_.triangles.size()));
  for (int axis = 0; axis < 2; ++axis) {
    bins_[axis] = static_cast<Index>(std::clamp(side, 1.0, 512.0));
    binSize_[axis] = std::max((high_[axis + 1] - low_[axis + 1]) / bins_[axis], 1e-300);
  }
  // twice over the triangles: count, then fill
  start_.assign(static_cast<std::size_t>(bins_[0]) * bins_[1] + 1, 0);
  std::vector<Index> next;
  for (const bool fill : {false, true}) {
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      std::array<Index, 2> from, to;
      for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::minmax({mesh_.positions[mesh_.triangles[f][0]][axis + 1],
                                              mesh_.positions[mesh_.triangles[f][1]][axis + 1],
                                              mesh_.positions[mesh_.triangles[f][2]][axis + 1]});
        from[axis] = binOf(low, axis);
        to[axis] = binOf(high, axis);
      }
      for (Index j = from[1]; j <= to[1]; ++j)
        for (Index i = from[0]; i <= to[0]; ++i) {
          const std::size_t bin = i + static_cast<std::size_t>(bins_[0]) * j;
          if (fill)
            binned_[next[bin]++] = static_cast<Index>(f);
          else
            ++start_[bin + 1];
        }
    }
    if (fill) break;
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    next.assign(start_.begin(), start_.end() - 1);
    binned_.resize(start_.back());
  }
}

// +1 where the line enters the solid through the triangle, -1 where it leaves, 0 where it misses.
int SolidScanner::crossing(const Triangle& t, double y, double z, double& x) const {
  const std::vector<Vec3>& p = mesh_.positions;
  const int s0 = side(p, t[0], t[1], y, z);
  if (s0 == 0 || side(p, t[1], t[2], y, z) != s0 || side(p, t[2], t[0], y, z) != s0) return 0;
  const double w0 = std::abs(orient(p[t[1]], p[t[2]], y, z));
  const double w1 = std::abs(orient(p[t[2]], p[t[0]], y, z));
  const double w2 = std::abs(orient(p[t[0]], p[t[1]], y, z));
  const double sum = w0 + w1 + w2;
  x = sum > 0 ? (w0 * p[t[0]][0] + w1 * p[t[1]][0] + w2 * p[t[2]][0]) / sum : p[t[0]][0];
  return -s0;
}

void SolidScanner::scan(double y, double z, std::vector<Interval>& out) const {
  out.clear();
  if (y < low_[1] || y > high_[1] || z < low_[2] || z > high_[2]) return;
  std::vector<Crossing> crossings;
  const std::size_t bin = binOf(y, 0) + static_cast<std::size_t>(bins_[0]) * binOf(z, 1);
  for (Index e = start_[bin]; e < start_[bin + 1]; ++e) {
    double x = 0;
    if (const int sign = crossing(mesh_.triangles[binned_[e]], y, z, x))
      crossings.push_back({x, sign});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.x != b.x ? a.x < b.x : a.sign > b.sign;
  });
  int depth = 0;
  double begin = 0;
  for (const Crossing& c : crossings) {
    if (depth == 0 && c.sign > 0) begin = c.x;
    if (depth == 1 && c.sign < 0 && c.x > begin) out.push_back({begin, c.x});
    depth += c.sign;
  }
}

bool SolidScanner::isInside(const Vec3& point) const {
  std::vector<Interval> inside;
  scan(point[1], point[2], inside);
  return std::any_of(inside.begin(), inside.end(), [&](const Interval& part) {
    return part.begin <= point[0] && point[0] <= part.end;
  });
}

SolidSamples SolidScanner::samples(double cell) const {
  // lines tile the body's extent
  const auto ny = std::max(Index{1}, static_cast<Index>(std::ceil((high_[1] - low_[1]) / cell)));
  const auto nz = std::max(Index{1}, static_cast<Index>(std::ceil((high_[2] - low_[2]) / cell)));
  SolidSamples all;
  all.dy = (high_[1] - low_[1]) / ny;
  all.dz = (high_[2] - low_[2]) / nz;
  std::vector<SolidSamples> slices(static_cast<std::size_t>(nz));
  parallelChunks(nz, 1, [&](Index begin, Index) {
    SolidSamples& slice = slices[begin];
    const double z = low_[2] + (begin + 0.5) * all.dz;
    std::vector<Interval> inside;
    for (Index j = 0; j < ny; ++j) {
      const double y = low_[1] + (j + 0.5) * all.dy;
      scan(y, z, inside);
      for (const Interval& part : inside)
        for (double voxel = std::floor((part.begin - low_[0]) / cell);; ++voxel) {
          const double from = std::max(part.begin, low_[0] + voxel * cell);
          const double to = std::min(part.end, low_[0] + (voxel + 1) * cell);
          if (to > from) {
            slice.positions.emplace_back(0.5 * (from + to), y, z);
            slice.volumes.push_back((to - from) * all.dy * all.dz);
          }
          if (low_[0] + (voxel + 1) * cell >= part.end) break;
        }
    }
  });
  for (const SolidSamples& slice : slices) {
    all.positions.insert(all.positions.end(), slice.positions.begin(), slice.positions.end());
    all.volumes.insert(all.volumes.end(), slice.volumes.begin(), slice.volumes.end());
  }
  return all;
}

}  // namespace stroma
