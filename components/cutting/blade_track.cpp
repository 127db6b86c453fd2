// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/blade_track.h"

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "components/cutting/cut_sheet.h"

namespace stroma {
namespace {

Mat3 rotationOf(const Mat3& A) {
  const Eigen::JacobiSVD<Mat3> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

std::vector<Vec3> BladeTrack::points(const Tool& tool) const {
  const std::span<const Vec3> corners = tool.edge();
  const auto segments = static_cast<int>(corners.size()) - 1;
  const int each = std::max(1, (count_ - 1 + segments - 1) / segments);
  std::vector<Vec3> out{corners.front()};
  for (std::size_t s = 0; s + 1 < corners.size(); ++s) {
    for (int k = 1; k < each; ++k)
      out.push_back(corners[s] + static_cast<double>(k) / each * (corners[s + 1] - corners[s]));
    out.push_back(corners[s + 1]);
  }
  return out;
}

bool BladeTrack::comesNear(const Tool& tool, ConstVec3Span now, const MechanicalState& particles,
                           double reach) {
  const std::vector<Vec3> local = points(tool);
  double way = 0.01 * reach;  // tissue moves too, if no faster than the tool
  for (std::size_t k = 0; k < now.size(); ++k)
    way = std::max(way, 2 * (now[k] - tool.previousPose() * local[k]).norm());
  clearance -= way;
  if (clearance > 0) return false;
  const ConstVec3Span x = particles.x();
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t particle = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const Vec3& p : now)
      if (const double d = (x[i] - p).squaredNorm(); d < nearest) nearest = d, particle = i;
  clearance = std::sqrt(nearest) - reach;
  if (clearance > 0) return false;
  edge.assign(now.begin(), now.end());
  for (Vec3& p : edge) p += particles.rest()[particle] - x[particle];
  return true;
}

bool BladeTrack::follow(const Tool& tool, const MechanicalState& particles,
                        const RestPlacement& placement) {
  before = edge;
  std::vector<Vec3> now = points(tool);
  for (Vec3& p : now) p = tool.pose() * p;
  if (edge.empty() && !comesNear(tool, now, particles, placement.reach())) return false;
  std::vector<std::optional<RestPlacement::Place>> places(now.size());
  for (std::size_t k = 0; k < now.size(); ++k)
    places[k] = placement.find(now[k], edge[k], particles.x());
  if (std::ranges::none_of(places, [](const auto& place) { return place.has_value(); })) {
    edge.clear();
    clearance = 0;
    return false;
  }
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (places[k]) {
      edge[k] = places[k]->rest;
      continue;
    }
    std::size_t m = now.size();
    for (std::size_t away = 1; m == now.size(); ++away) {
      if (k >= away && places[k - away])
        m = k - away;
      else if (k + away < now.size() && places[k + away])
        m = k + away;
    }
    edge[k] = places[m]->rest + rotationOf(places[m]->inverse) * (now[k] - now[m]);
  }
  if (isRing(now)) edge.back() = edge.front();  // also where its seam has no particles around
  return true;
}

}  // namespace stroma
