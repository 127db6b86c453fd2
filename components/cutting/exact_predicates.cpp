// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

namespace stroma {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_rational;

Kernel::Point_3 point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// Sign of (b - a) x (d - c), first component that is not zero. Called for ties only.
int signOfShiftTerm(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<Exact, 3> u, w;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    u[i] = Exact(b[k]) - Exact(a[k]);
    w[i] = Exact(d[k]) - Exact(c[k]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const int sign = CGAL::sign(Exact(u[j] * w[k] - u[k] * w[j]));
    if (sign != 0) return sign;
  }
  return 0;
}

// Orientation of the shifted segment pq against the line through a and b.
int sideOfLine(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const int sign = orientation(p, q, a, b);
  return sign != 0 ? sign : signOfShiftTerm(p, q, a, b);
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return CGAL::orientation(point(a), point(b), point(c), point(d));
}

int sideOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = orientation(a, b, c, d);
  return sign != 0 ? sign : signOfShiftTerm(a, b, a, c);
}

bool segmentCrossesTriangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                            const Vec3& c) {
  const int sideP = sideOf(a, b, c, p), sideQ = sideOf(a, b, c, q);
  if (sideP == 0 || sideP == sideQ) return false;
  const int ab = sideOfLine(p, q, a, b);
  return ab != 0 && ab == sideOfLine(p, q, b, c) && ab == sideOfLine(p, q, c, a);
}

}  // namespace stroma
