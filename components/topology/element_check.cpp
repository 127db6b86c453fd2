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

}  // namespace stroma
