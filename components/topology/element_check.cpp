// SPDX-License-Identifier: Apache-2.0
#include "components/topology/element_check.h"

#include <cmath>

namespace stroma {

std::vector<double> lumpedVolumes(ConstVec3Span x, std::span<const Tetrahedron> tetrahedra) {
  std::vector<double> volumes(x.size(), 0.0);
  for (const Tetrahedron& t : tetrahedra) {
    const Vec3 &a = x[static_cast<std::size_t>(t[0])], &b = x[static_cast<std::size_t>(t[1])],
               &c = x[static_cast<std::size_t>(t[2])], &d = x[static_cast<std::size_t>(t[3])];
    const double volume = std::abs((b - a).cross(c - a).dot(d - a)) / 6;
    for (const Index i : t) volumes[static_cast<std::size_t>(i)] += volume / 4;
  }
  return volumes;
}

std::vector<double> lumpedVolumes(ConstVec3Span x, std::span<const Hexahedron> hexahedra) {
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::vector<double> volumes(x.size(), 0.0);
  for (const Hexahedron& h : hexahedra) {
    const Vec3& origin = x[static_cast<std::size_t>(h[0])];
    const auto corner = [&](std::size_t k) -> Vec3 {
      return x[static_cast<std::size_t>(h[k])] - origin;
    };
    // what a bilinear face bounds is the mean of its two ways to be split into triangles
    double six = 0;
    for (const auto& face : faces)
      for (std::size_t k = 0; k < 4; ++k)
        six +=
            0.5 * corner(face[k]).cross(corner(face[(k + 1) % 4])).dot(corner(face[(k + 2) % 4]));
    for (const Index i : h) volumes[static_cast<std::size_t>(i)] += std::abs(six) / 6 / 8;
  }
  return volumes;
}

}  // namespace stroma
