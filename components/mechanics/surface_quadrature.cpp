// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/surface_quadrature.h"

#include <algorithm>
#include <cmath>

namespace stroma {
namespace {

// n^2 equal pieces, n (n + 1) / 2 the way up and the rest upside down, each sampled at its
// centroid.
void sampleTriangle(const std::array<Vec3, 3>& x, Index triangle, int n,
                    std::vector<SurfaceSample>& samples) {
  const Vec3 area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]) / (n * n);
  const auto add = [&](double i, double j) {
    const Vec3 b(i / n, j / n, 1 - (i + j) / n);
    samples.push_back({b[0] * x[0] + b[1] * x[1] + b[2] * x[2], area, triangle, b});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3, j + 1.0 / 3);
      if (i + j < n - 1) add(i + 2.0 / 3, j + 2.0 / 3);
    }
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(ConstVec3Span nodes, std::span<const Triangle> triangles,
                                         double maxEdge) {
  std::vector<SurfaceSample> samples;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array<Vec3, 3> x{nodes[triangles[t][0]], nodes[triangles[t][1]],
                                nodes[triangles[t][2]]};
    const double longest =
        std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
    const int pieces =
        maxEdge > 0 ? std::max(1, static_cast<int>(std::ceil(longest / maxEdge))) : 1;
    sampleTriangle(x, static_cast<Index>(t), pieces, samples);
  }
  return samples;
}

}  // namespace stroma
