// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/level_set.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stroma::meshes {
namespace {

Vec3 gradient(const LevelSet& f, const Vec3& p) {
  constexpr double h = 1e-5;
  Vec3 g;
  for (int d = 0; d < 3; ++d) {
    const Vec3 e = h * Vec3::Unit(d);
    g[d] = (f(p + e) - f(p - e)) / (2 * h);
  }
  return g;
}

struct HalfEdge {
  Edge edge;  // smaller node first
  Index triangle;
  Index opposite;
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> all;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Index a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      all.push_back(
          {{std::min(a, b), std::max(a, b)}, static_cast<Index>(f), triangles[f][(k + 2) % 3]});
    }
  std::sort(all.begin(), all.end(), [](const HalfEdge& p, const HalfEdge& q) {
    return p.edge != q.edge ? p.edge < q.edge : p.triangle < q.triangle;
  });
  return all;
}

double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - apex, v = b - apex;
  return u.dot(v) / u.cross(v).norm();
}

Triangle replaced(Triangle t, Index from, Index to) {
  std::replace(t.begin(), t.end(), from, to);
  return t;
}

// One pass; every triangle takes part in one flip at most.
void flipEdges(SurfaceMesh& mesh) {
  const std::vector<Vec3>& x = mesh.positions;
  const std::vector<HalfEdge> all = sortedHalfEdges(mesh.triangles);
  std::set<Edge> existing;
  for (const HalfEdge& h : all) existing.insert(h.edge);
  std::vector<bool> touched(mesh.triangles.size(), false);
  for (std::size_t e = 1; e < all.size(); ++e) {
    const HalfEdge &p = all[e - 1], &q = all[e];
    if (p.edge != q.edge || touched[p.triangle] || touched[q.triangle]) continue;
    const auto [a, b] = p.edge;
    const Index c = p.opposite, d = q.opposite;
    // a margin, so that rounding never decides
    if (cotangent(x[c], x[a], x[b]) + cotangent(x[d], x[a], x[b]) > -1e-6) continue;
    if (existing.count({std::min(c, d), std::max(c, d)})) continue;
    // not across a fold
    const Triangle first = replaced(mesh.triangles[p.triangle], a, d);
    const Triangle second = replaced(mesh.triangles[q.triangle], b, c);
    const Vec3 old =
        vectorArea(x, mesh.triangles[p.triangle]) + vectorArea(x, mesh.triangles[q.triangle]);
    if (vectorArea(x, first).dot(old) <= 0 || vectorArea(x, second).dot(old) <= 0) continue;
    existing.erase(p.edge);
    existing.insert({std::min(c, d), std::max(c, d)});
    mesh.triangles[p.triangle] = first;
    mesh.triangles[q.triangle] = second;
    touched[p.triangle] = touched[q.triangle] = true;
  }
}

void smooth(const LevelSet& f, const std::vector<bool>& fixed, SurfaceMesh& mesh) {
  std::vector<Vec3> sum(mesh.positions.size(), Vec3::Zero());
  std::vector<double> weight(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const double area = vectorArea(mesh.positions, t).norm();
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
    for (const Index v : t) {
      sum[v] += area * middle;
      weight[v] += area;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (fixed[i]) continue;
    const Vec3 towards = 0.7 * (sum[i] / weight[i] - mesh.positions[i]);
    mesh.positions[i] = project(f, mesh.positions[i] + towards);
  }
}

}  // namespace

double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& semiAxes) {
  const Vec3 q = (p - center).cwiseQuotient(semiAxes);
  const double scaled = q.norm();
  const double slope = q.cwiseQuotient(semiAxes).norm();
  return slope > 0 ? scaled * (scaled - 1) / slope : -semiAxes.minCoeff();
}

double taperedRod(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb) {
  const Vec3 axis = b - a;
  const double length = axis.norm();
  // the foot point leans along the cone's generator
  const double lean = (ra - rb) / length;
  const Vec3 d = p - a;
  const double along = d.dot(axis) / length;
  const double across = std::sqrt(std::max(0.0, d.squaredNorm() - along * along));
  const double foot = along - across * lean / std::sqrt(std::max(1e-12, 1 - lean * lean));
  const double share = std::clamp(foot / length, 0.0, 1.0);
  return (d - share * axis).norm() - (ra + share * (rb - ra));
}

double smoothUnion(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double smoothDifference(double a, double b, double k) { return -smoothUnion(-a, b, k); }

double castRay(const LevelSet& f, const Vec3& inside, const Vec3& direction, double farthest) {
  double high = farthest;
  while (high > 0 && f(inside + (high - 0.01 * farthest) * direction) > 0) high -= 0.01 * farthest;
  double low = high - 0.01 * farthest;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (f(inside + middle * direction) > 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

Vec3 project(const LevelSet& f, Vec3 p) {
  for (int k = 0; k < 8; ++k) {
    const Vec3 g = gradient(f, p);
    const double value = f(p);
    if (std::abs(value) < 1e-12) break;
    p -= value / g.squaredNorm() * g;
  }
  return p;
}

void relax(const LevelSet& f, int steps, SurfaceMesh& mesh) {
  std::vector<bool> fixed(mesh.positions.size(), false);
  for (const std::vector<Index>& loop : boundaryLoops(mesh.triangles))
    for (const Index v : loop) fixed[v] = true;
  for (int step = 0; step < steps; ++step) {
    flipEdges(mesh);
    smooth(f, fixed, mesh);
  }
}

}  // namespace stroma::meshes
