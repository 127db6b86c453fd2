// SPDX-License-Identifier: Apache-2.0
#include "components/topology/region.h"

namespace stroma {

bool contains(const Box& box, const Vec3& point) {
  return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

bool contains(const OrientedBox& box, const Vec3& point) {
  const Vec3 at = box.axes * (point - box.corner);
  return (at.array() >= 0).all() && (at.array() <= box.size.array()).all();
}

bool contains(const Ball& ball, const Vec3& point) {
  return (point - ball.center).squaredNorm() <= ball.radius * ball.radius;
}

OrientedBox orientedBox(std::span<const double, 10> numbers) {
  const auto point = [&](std::size_t i) {
    return Vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  };
  const Vec3 along = point(1) - point(0);
  const Vec3 u = along.normalized();
  Vec3 across = point(2) - point(1);
  across -= across.dot(u) * u;
  const Vec3 v = across.normalized(), w = u.cross(v);
  const double depth = numbers[9];
  OrientedBox box;
  box.axes << u.transpose(), v.transpose(), w.transpose();
  box.size = Vec3(along.norm(), across.norm(), depth);
  box.corner = point(0) - 0.5 * depth * w;
  return box;
}

}  // namespace stroma
