// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/surface_closing.h"

namespace stroma {
namespace {

Vec3 middleOf(ConstVec3Span x, const std::vector<Index>& loop) {
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3& a = x[loop[k]];
    const Vec3& b = x[loop[(k + 1) % loop.size()]];
    const double weight = (b - a).norm();
    sum += 0.5 * weight * (a + b);
    length += weight;
  }
  return length > 0 ? Vec3(sum / length) : x[loop.front()];
}

}  // namespace

SurfaceMesh capRims(ConstVec3Span x, TriangleSpan triangles) {
  SurfaceMesh closed{{x.begin(), x.end()}, {triangles.begin(), triangles.end()}};
  for (const std::vector<Index>& loop : boundaryLoops(triangles)) {
    const auto hub = static_cast<Index>(closed.positions.size());
    closed.positions.push_back(middleOf(x, loop));
    for (std::size_t k = 0; k < loop.size(); ++k)
      closed.triangles.push_back({loop[(k + 1) % loop.size()], loop[k], hub});
  }
  return closed;
}

ShellSheets thickenSheet(ConstVec3Span x, TriangleSpan triangles, double thickness) {
  const std::vector<Vec3> normals = nodalNormals(x, triangles);
  ShellSheets sheets{
      {x.begin(), x.end()}, {x.begin(), x.end()}, {triangles.begin(), triangles.end()}};
  for (std::size_t i = 0; i < x.size(); ++i) sheets.inner[i] -= thickness * normals[i];
  return sheets;
}

SurfaceMesh closeSheets(const ShellSheets& s) {
  SurfaceMesh closed{s.outer, s.triangles};
  const auto below = static_cast<Index>(s.outer.size());
  closed.positions.insert(closed.positions.end(), s.inner.begin(), s.inner.end());
  for (const Triangle& t : s.triangles)
    closed.triangles.push_back({t[0] + below, t[2] + below, t[1] + below});
  for (const std::vector<Index>& loop : boundaryLoops(s.triangles))
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Index a = loop[k], b = loop[(k + 1) % loop.size()];
      closed.triangles.push_back({a, a + below, b + below});
      closed.triangles.push_back({a, b + below, b});
    }
  return closed;
}

}  // namespace stroma
