// SPDX-License-Identifier: Apache-2.0
// The few types that everything else is written in. Lengths, masses, times are SI inside the
// library.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stroma {

using Index = std::int32_t;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

using Edge = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Quad = std::array<Index, 4>;
using Tetrahedron = std::array<Index, 4>;
using Hexahedron = std::array<Index, 8>;

using Vec3Span = std::span<Vec3>;
using ConstVec3Span = std::span<const Vec3>;

// A field of vectors seen as one column of 3N numbers, for dot products and updates.
inline Eigen::Map<Eigen::VectorXd> flat(Vec3Span a) {
  return {a.empty() ? nullptr : a.front().data(), static_cast<Eigen::Index>(3 * a.size())};
}
inline Eigen::Map<const Eigen::VectorXd> flat(ConstVec3Span a) {
  return {a.empty() ? nullptr : a.front().data(), static_cast<Eigen::Index>(3 * a.size())};
}

}  // namespace stroma
