// SPDX-License-Identifier: Apache-2.0
// Rotations between two orientations, as vectors: axis times angle (rad), in the scene's frame.
#pragma once

#include <cmath>
#include <numbers>

#include "core/types.h"

namespace stroma {

// The shortest rotation that takes `from` to `to`. Both are unit quaternions.
[[nodiscard]] inline Vec3 rotationVector(const Quat& from, const Quat& to) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  // near zero, 2 asin(s) / s = 2: the angle's own formula would divide by zero
  return sine > 1e-12 ? Vec3(turn.vec() * (2 * std::atan2(sine, turn.w()) / sine))
                      : Vec3(2 * turn.vec());
}

// Orientation after the rotation.
[[nodiscard]] inline Quat rotated(const Quat& from, const Vec3& rotation) {
  const double angle = rotation.norm();
  if (angle == 0) return from;
  return Quat(Eigen::AngleAxisd(angle, rotation / angle)) * from;
}

// Euler angles (degrees) as SOFA writes them: about x, then about the fixed y, then the fixed z.
[[nodiscard]] inline Quat fromEuler(const Vec3& degrees) {
  const Vec3 a = degrees * (std::numbers::pi / 180);
  return Quat(Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
              Eigen::AngleAxisd(a.x(), Vec3::UnitX()));
}

}  // namespace stroma
