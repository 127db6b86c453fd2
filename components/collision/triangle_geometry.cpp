// SPDX-License-Identifier: Apache-2.0
#include "components/collision/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stroma {
namespace {

// Volume of (p - a, b - a, c - a) over time when all points move straight.
struct Cubic {
  double c0, c1, c2, c3;  // powers of time
  [[nodiscard]] double operator()(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
};

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

Cubic volumeOverTime(const Vec3& p0, const Vec3& p1, const Corners& t0, const Corners& t1) {
  const Vec3 u = p0 - t0.a, v = t0.b - t0.a, w = t0.c - t0.a;
  const Vec3 du = (p1 - t1.a) - u, dv = (t1.b - t1.a) - v, dw = (t1.c - t1.a) - w;
  return {triple(u, v, w), triple(du, v, w) + triple(u, dv, w) + triple(u, v, dw),
          triple(u, dv, dw) + triple(du, v, dw) + triple(du, dv, w), triple(du, dv, dw)};
}

// Times in (0, 1) that split it into pieces on which the cubic is monotone.
int extrema(const Cubic& f, std::array<double, 2>& times) {
  const double a = 3 * f.c3, b = 2 * f.c2, c = f.c1;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant <= 0) return 0;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  int count = 0;
  for (const double root : {a != 0 ? q / a : -1.0, q != 0 ? c / q : -1.0}) {
    if (root > 0 && root < 1) times[static_cast<std::size_t>(count++)] = root;
  }
  if (count == 2 && times[0] > times[1]) std::swap(times[0], times[1]);
  return count;
}

// Where a monotone piece that ends below zero gets there.
double fall(const Cubic& f, double low, double high) {
  for (int k = 0; k < 60 && low < high; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (f(middle) >= 0 ? low : high) = middle;
  }
  return high;
}

std::optional<Vec3> weightsInside(const Corners& t, const Vec3& p, double tolerance) {
  const Vec3 n = t.areaNormal();
  const double area2 = n.squaredNorm();
  if (!(area2 > 0)) return std::nullopt;
  Vec3 w;
  w[1] = (p - t.a).cross(t.c - t.a).dot(n) / area2;
  w[2] = (t.b - t.a).cross(p - t.a).dot(n) / area2;
  w[0] = 1 - w[1] - w[2];
  if (w.minCoeff() < -tolerance) return std::nullopt;
  w = w.cwiseMax(0);
  return w / w.sum();
}

}  // namespace

std::optional<Crossing> firstEntry(const Vec3& p0, const Vec3& p1, const Corners& t0,
                                   const Corners& t1, double tolerance) {
  const Cubic volume = volumeOverTime(p0, p1, t0, t1);
  std::array<double, 2> splits{};
  const int count = extrema(volume, splits);
  double low = 0;
  for (int piece = 0; piece <= count; ++piece) {
    const double high = piece < count ? splits[static_cast<std::size_t>(piece)] : 1;
    if (volume(low) >= 0 && volume(high) < 0) {
      const double time = fall(volume, low, high);
      const auto mix = [&](const Vec3& from, const Vec3& to) {
        return Vec3(from + time * (to - from));
      };
      const Corners now{mix(t0.a, t1.a), mix(t0.b, t1.b), mix(t0.c, t1.c)};
      if (const auto weights = weightsInside(now, mix(p0, p1), tolerance)) {
        return Crossing{time, *weights};
      }
    }
    low = high;
  }
  return std::nullopt;
}

}  // namespace stroma
