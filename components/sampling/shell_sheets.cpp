// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/shell_sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "components/sampling/point_grid.h"
#include "components/sampling/surface_check.h"
#include "core/triangle.h"

namespace stroma {
namespace {

// The patch of every triangle after cutting along creases: union of smoothly joined neighbours.
std::vector<Index> smoothPatches(ConstVec3Span x, TriangleSpan triangles, double creaseAngle) {
  std::vector<Index> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  std::vector<std::pair<Edge, Index>> edges;
  std::vector<Vec3> normal;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    normal.push_back(vectorArea(x, t).stableNormalized());
    for (int k = 0; k < 3; ++k)
      edges.push_back({{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])},
                       static_cast<Index>(f)});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 1; e < edges.size(); ++e) {
    const auto [f, g] = std::pair{edges[e - 1].second, edges[e].second};
    if (edges[e - 1].first == edges[e].first && normal[f].dot(normal[g]) > std::cos(creaseAngle))
      parent[std::max(root(f), root(g))] = std::min(root(f), root(g));
  }
  for (std::size_t f = 0; f < parent.size(); ++f) parent[f] = root(static_cast<Index>(f));
  return parent;
}

// A patch as a surface of its own.
SurfaceMesh extract(ConstVec3Span x, TriangleSpan triangles, const std::vector<Index>& patchOf,
                    Index patch) {
  SurfaceMesh mesh;
  std::vector<Index> number(x.size(), -1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (patchOf[f] != patch) continue;
    Triangle& t = mesh.triangles.emplace_back(triangles[f]);
    for (Index& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(x[v]);
      }
      v = number[v];
    }
  }
  return mesh;
}

Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length = d.squaredNorm();
  return length > 0 ? Vec3(a + std::clamp((p - a).dot(d) / length, 0.0, 1.0) * d) : a;
}

// Nearest points of a surface or of its rim: looks at the triangles (rim edges) around the nearest
// nodes only, which is exact as long as triangles are not much longer than the shell is thick, and
// close to it otherwise.
class NearestPoints {
 public:
  explicit NearestPoints(const SurfaceMesh& mesh)
      : mesh_(mesh),
        edge_(std::sqrt(surfaceArea(mesh.positions, mesh.triangles) / mesh.triangles.size())),
        grid_(mesh.positions, 1.5 * edge_),
        around_(mesh.positions.size()) {
    for (const Triangle& t : mesh.triangles)
      for (const Index v : t) around_[v].push_back(t);
    for (const std::vector<Index>& loop : boundaryLoops(mesh.triangles))
      for (std::size_t k = 0; k < loop.size(); ++k) {
        rimNodes_.push_back(mesh.positions[loop[k]]);
        rimEnds_.push_back(mesh.positions[loop[(k + 1) % loop.size()]]);
      }
  }

  [[nodiscard]] Vec3 onSurface(const Vec3& p) const {
    const Index first = grid_.nearest(p);
    const double reach = (mesh_.positions[first] - p).norm() + edge_;
    Vec3 best = mesh_.positions[first];
    double bestSquared = (best - p).squaredNorm();
    grid_.forEachWithin(p, reach, [&](Index v, double) {
      for (const Triangle& t : around_[v]) {
        const TrianglePoint q = nearestOnTriangle(cornersOf(t, mesh_.positions), p);
        if (q.distance2 < bestSquared) {
          best = q.point;
          bestSquared = q.distance2;
        }
      }
    });
    return best;
  }

  [[nodiscard]] bool hasRim() const { return !rimNodes_.empty(); }

  [[nodiscard]] Vec3 onRim(const Vec3& p) const {
    Vec3 best = rimNodes_.front();
    for (std::size_t k = 0; k < rimNodes_.size(); ++k) {
      const Vec3 q = nearestOnSegment(p, rimNodes_[k], rimEnds_[k]);
      if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
    }
    return best;
  }

 private:
  const SurfaceMesh& mesh_;
  double edge_;
  PointGrid grid_;
  std::vector<std::vector<Triangle>> around_;
  std::vector<Vec3> rimNodes_, rimEnds_;
};

ShellSheets pairSheets(SurfaceMesh outer, const SurfaceMesh& inner) {
  const NearestPoints below(inner);
  ShellSheets sheets{std::move(outer.positions), {}, std::move(outer.triangles)};
  for (const Vec3& p : sheets.outer) sheets.inner.push_back(below.onSurface(p));
  if (below.hasRim())
    for (const std::vector<Index>& loop : boundaryLoops(sheets.triangles))
      for (const Index v : loop) sheets.inner[v] = below.onRim(sheets.outer[v]);
  return sheets;
}

// The share of the outer sheet's area below which, along its inward normal, the inner sheet lies.
double facingShare(const ShellSheets& s) {
  double facing = 0, all = 0;
  for (const Triangle& t : s.triangles) {
    const Vec3 area = vectorArea(s.outer, t);
    Vec3 down = Vec3::Zero();
    for (const Index v : t) down += s.inner[v] - s.outer[v];
    all += area.norm();
    if (-down.dot(area) > 0.7 * down.norm() * area.norm()) facing += area.norm();
  }
  return facing / all;
}

}  // namespace

FoundSheets findSheets(ConstVec3Span x, TriangleSpan triangles, double creaseAngle) {
  FoundSheets found;
  found.problem = whyNotClosed(x, triangles);
  if (!found.problem.empty()) return found;
  found.volume = enclosedVolume(x, triangles);

  const std::vector<Index> patchOf = smoothPatches(x, triangles, creaseAngle);
  std::vector<double> area(triangles.size(), 0);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    area[patchOf[f]] += vectorArea(x, triangles[f]).norm();
  const auto largest = [&] {
    return static_cast<Index>(std::max_element(area.begin(), area.end()) - area.begin());
  };
  const Index outer = largest();
  const double outerArea = std::exchange(area[outer], 0);
  const Index inner = largest();
  if (!(area[inner] > 0.25 * outerArea)) {
    found.problem = "the surface is not a shell of two sheets: no two large smooth faces in it";
    return found;
  }
  found.sheets =
      pairSheets(extract(x, triangles, patchOf, outer), extract(x, triangles, patchOf, inner));
  if (const double share = facingShare(found.sheets); share < 0.9)
    found.problem =
        "the surface is not a shell of two sheets: its two largest faces lie back to back "
        "only over " +
        std::to_string(static_cast<int>(100 * share)) + " % of their area";
  else if (found.volume / outerArea > 0.5 * std::sqrt(outerArea))
    found.problem = "the body is too thick to be sampled as a shell";
  return found;
}

}  // namespace stroma
