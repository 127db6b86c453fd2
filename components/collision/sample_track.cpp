// SPDX-License-Identifier: Apache-2.0
#include "components/collision/sample_track.h"

#include <cmath>
#include <limits>

namespace stroma {
namespace {

Touch touchAt(const BVHCollisionModel& surface, const NearestTriangle& near, const Vec3& p,
              double radius, bool inside) {
  Touch touch{near.triangle, near.at.weights, near.at.point, {}, 0, inside};
  const double distance = std::sqrt(near.at.distance2);
  touch.depth = inside ? radius + distance : radius - distance;
  // too near to give a direction, or on the surface
  const bool tells = distance > 1e-6 * surface.meanEdge();
  touch.normal = tells ? Vec3((p - near.at.point) / (inside ? -distance : distance))
                       : surface.outward(near.triangle, near.at.weights);
  return touch;
}

double side(const BVHCollisionModel& surface, const NearestTriangle& near, const Vec3& p) {
  return (p - near.at.point).dot(surface.outward(near.triangle, near.at.weights));
}

}  // namespace

void SampleTrack::setOutside(const Vec3& position) {
  where_ = Where::outside;
  position_ = position;
}

std::optional<Touch> SampleTrack::follow(const BVHCollisionModel& surface, const Vec3& from,
                                         const Vec3& to, double radius, double margin) {
  // set to a new place, not moved there: what lay on the way was not met
  if (where_ != Where::unknown && position_ != from) forget();
  const bool known = where_ != Where::unknown;
  const Vec3 begin = known ? position_ : from;
  position_ = to;
  if (inside()) {
    triangle_ = surface.pieceNear(triangle_, begin);
    if (const auto touch = held(surface, to, radius)) return touch;
  } else if (const FirstCrossing entry = surface.firstEntry(begin, to); entry.triangle >= 0) {
    where_ = Where::inside;
    triangle_ = entry_ = entry.triangle;
    if (const auto touch = held(surface, to, radius)) return touch;
  }
  const bool asks = surface.closed() && !known;
  const double reach = asks ? std::numeric_limits<double>::max() : radius + margin;
  const NearestTriangle near = surface.nearest(to, reach);
  where_ = Where::outside;
  if (near.triangle < 0) return std::nullopt;
  if (side(surface, near, to) < 0) {
    if (!surface.closed()) return std::nullopt;
    where_ = Where::inside;
    triangle_ = entry_ = near.triangle;
    return touchAt(surface, near, to, radius, true);
  }
  if (near.at.distance2 > (radius + margin) * (radius + margin)) return std::nullopt;
  return touchAt(surface, near, to, radius, false);
}

std::optional<Touch> SampleTrack::held(const BVHCollisionModel& surface, const Vec3& p,
                                       double radius) {
  const auto triangles = surface.triangles();
  const auto gone = [&](Index t) { return isGone(triangles[static_cast<std::size_t>(t)]); };
  if (gone(triangle_) || gone(entry_)) return std::nullopt;  // cut away: it is looked up anew
  const Vec3 facing = surface.outward(entry_, Vec3::Constant(1.0 / 3));
  const NearestTriangle near = surface.slide(p, triangle_, facing);
  if (side(surface, near, p) >= 0) return std::nullopt;
  triangle_ = near.triangle;
  const Touch touch = touchAt(surface, near, p, radius, true);
  // while it is not deep it may go round a body; deep inside a sheet the way back is kept
  if (std::sqrt(near.at.distance2) < 0.5 * surface.meanEdge()) entry_ = triangle_;
  return touch;
}

void SampleTrack::save(std::span<double> numbers) const {
  numbers[0] = static_cast<double>(where_);
  for (std::size_t k = 0; k < 3; ++k) numbers[1 + k] = position_[static_cast<Eigen::Index>(k)];
  numbers[4] = triangle_;
  numbers[5] = entry_;
}

void SampleTrack::restore(std::span<const double> numbers) {
  where_ = static_cast<Where>(static_cast<int>(numbers[0]));
  position_ = {numbers[1], numbers[2], numbers[3]};
  triangle_ = static_cast<Index>(numbers[4]);
  entry_ = static_cast<Index>(numbers[5]);
}

}  // namespace stroma
