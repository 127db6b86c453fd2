// SPDX-License-Identifier: Apache-2.0
#include "core/triangle.h"

namespace stroma {
namespace {

TrianglePoint at(const Corners& t, const Vec3& p, const Vec3& weights) {
  const Vec3 point = t.at(weights);
  return {weights, point, (p - point).squaredNorm()};
}

}  // namespace

TrianglePoint nearestOnTriangle(const Corners& t, const Vec3& p) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return at(t, p, {1, 0, 0});
  const Vec3 bp = p - t.b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return at(t, p, {0, 1, 0});
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return at(t, p, {1 - s, s, 0});
  }
  const Vec3 cp = p - t.c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return at(t, p, {0, 0, 1});
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return at(t, p, {1 - s, 0, s});
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(t, p, {0, 1 - s, s});
  }
  const double sum = va + vb + vc;
  const double v = vb / sum, w = vc / sum;
  return at(t, p, {1 - v - w, v, w});
}

double enclosedVolume(ConstVec3Span positions, std::span<const Triangle> triangles) {
  if (positions.empty()) return 0;
  // taken about a point of the mesh, so that a body far from the origin loses no digits
  const Vec3& origin = positions.front();
  double sixfold = 0;
  for (const Triangle& t : triangles) {
    const Corners c = cornersOf(t, positions);
    sixfold += (c.a - origin).dot((c.b - origin).cross(c.c - origin));
  }
  return sixfold / 6;
}

}  // namespace stroma
