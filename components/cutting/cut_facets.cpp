// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_facets.h"

#include <algorithm>

#include "components/cutting/exact_predicates.h"
#include "core/triangle.h"

namespace stroma {
namespace {

// Sign of the determinant of three differences of points; 0 where rounding could have changed it.
// The bound, some ten times the least (Shewchuk 1997), is by the product of the differences' sums
// of components; a little more covers underflow.
int clearSign(double determinant, double product) {
  const double bound = 1e-14 * product + 1e-290;
  return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
}

}  // namespace

CutFacets::CutFacets(double cell) : grid_(cell) {}

void CutFacets::add(std::span<const RestTriangle> facets) {
  for (const RestTriangle& t : facets) {
    const Box box{t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
    grid_.insert(count(), box.low, box.high);
    facets_.push_back(t);
    boxes_.push_back(box);
    planes_.emplace_back(t);
    all_ = {all_.low.cwiseMin(box.low), all_.high.cwiseMax(box.high)};
  }
}

// What lies near any of the segments is gathered once: most of them meet no facet's box, and most
// of the others lie on one side of the facet's plane.
void CutFacets::block(const Vec3& from, ConstVec3Span to, std::span<char> blocked) const {
  std::ranges::fill(blocked, 0);
  Box all{from, from};
  for (const Vec3& end : to) all = {all.low.cwiseMin(end), all.high.cwiseMax(end)};
  std::vector<Near> near = meeting(all);
  for (Near& f : near) f.side = planes_[static_cast<std::size_t>(f.facet)].clearSideOf(from);
  if (near.empty()) return;
  for (std::size_t k = 0; k < to.size(); ++k) blocked[k] = crossesOneOf(near, from, to[k]) ? 1 : 0;
}

bool CutFacets::near(const Vec3& point, double reach) const {
  bool found = false;
  const Vec3 box = Vec3::Constant(reach);
  grid_.query(point - box, point + box, [&](Index k) {
    if (found) return;
    const RestTriangle& t = facets_[static_cast<std::size_t>(k)];
    found = nearestOnTriangle({t[0], t[1], t[2]}, point).distance2 <= reach * reach;
  });
  return found;
}

bool CutFacets::crossesNew(const Vec3& a, const Vec3& b, Index mark) const {
  std::vector<Near> near = meeting({a.cwiseMin(b), a.cwiseMax(b)});
  std::erase_if(near, [mark](const Near& f) { return f.facet < mark; });
  return crossesOneOf(near, a, b);
}

// Some more than once, their sides not yet known.
std::vector<CutFacets::Near> CutFacets::meeting(const Box& box) const {
  std::vector<Near> near;
  if (!all_.meets(box)) return near;
  constexpr std::size_t usually = 128;
  near.reserve(usually);
  grid_.query(box.low.cwiseMax(all_.low), box.high.cwiseMin(all_.high), [&](Index k) {
    if (boxes_[static_cast<std::size_t>(k)].meets(box)) near.push_back({k, 0});
  });
  return near;
}

bool CutFacets::crossesOneOf(std::span<const Near> facets, const Vec3& a, const Vec3& b) const {
  const Box box{a.cwiseMin(b), a.cwiseMax(b)};
  return std::ranges::any_of(facets, [&](const Near& f) {
    const auto k = static_cast<std::size_t>(f.facet);
    if (!boxes_[k].meets(box)) return false;
    const int side = f.side != 0 ? planes_[k].clearSideOf(b) : 0;
    if (side != 0 && side == f.side) return false;
    const RestTriangle& t = facets_[k];
    const int within = side != 0 ? clearlyThrough(a, b, t) : 0;
    return within != 0 ? within > 0 : segmentCrossesTriangle(a, b, t[0], t[1], t[2]);
  });
}

// Whether the line through a and b goes through the triangle (1) or beside it (-1); 0 where
// rounding could matter.
int CutFacets::clearlyThrough(const Vec3& a, const Vec3& b, const RestTriangle& t) {
  const Vec3 way = b - a;
  const std::array<Vec3, 3> corners{t[0] - a, t[1] - a, t[2] - a};
  std::array<int, 3> turns;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = corners[k], &to = corners[(k + 1) % 3];
    turns[k] =
        clearSign(from.cross(to).dot(way), from.lpNorm<1>() * to.lpNorm<1>() * way.lpNorm<1>());
  }
  const auto has = [&](int sign) { return std::ranges::find(turns, sign) != turns.end(); };
  if (has(1) && has(-1)) return -1;
  return has(0) ? 0 : 1;
}

CutFacets::Plane::Plane(const RestTriangle& t)
    : origin(t[0]),
      normal((t[1] - t[0]).cross(t[2] - t[0])),
      size((t[1] - t[0]).lpNorm<1>() * (t[2] - t[0]).lpNorm<1>()) {}

int CutFacets::Plane::clearSideOf(const Vec3& x) const {
  const Vec3 d = x - origin;
  return clearSign(normal.dot(d), size * d.lpNorm<1>());
}

bool CutFacets::crossesBruteForce(const Vec3& a, const Vec3& b) const {
  for (const RestTriangle& t : facets_)
    if (segmentCrossesTriangle(a, b, t[0], t[1], t[2])) return true;
  return false;
}

}  // namespace stroma
