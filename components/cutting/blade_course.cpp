// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/blade_course.h"

#include <algorithm>

#include "components/cutting/cut_sheet.h"
#include "components/cutting/exact_predicates.h"
#include "core/sorted_ids.h"

namespace stroma {
namespace {

Vec3 low(const RestTriangle& t) { return t[0].cwiseMin(t[1]).cwiseMin(t[2]); }
Vec3 high(const RestTriangle& t) { return t[0].cwiseMax(t[1]).cwiseMax(t[2]); }

double meanEdge(const std::vector<RestTriangle>& surface) {
  double sum = 0;
  for (const RestTriangle& t : surface)
    sum += (t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm();
  return surface.empty() ? 1 : sum / static_cast<double>(3 * surface.size());
}

}  // namespace

BladeCourse::BladeCourse(std::vector<RestTriangle> surface, bool closed)
    : surface_(std::move(surface)),
      closed_(closed),
      grid_(meanEdge(surface_)),
      low_(Vec3::Constant(1e300)),
      high_(Vec3::Constant(-1e300)) {
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    grid_.insert(static_cast<Index>(k), low(surface_[k]), high(surface_[k]));
    low_ = low_.cwiseMin(low(surface_[k]));
    high_ = high_.cwiseMax(high(surface_[k]));
  }
}

// Shares of the segment's length at which it goes through the surface, ascending.
void BladeCourse::crossings(const Vec3& p, const Vec3& q, std::vector<double>& along) const {
  std::vector<Index> near;
  along.clear();
  // an edge may be much longer than the body
  const Vec3 from = p.cwiseMin(q).cwiseMax(low_), to = p.cwiseMax(q).cwiseMin(high_);
  if ((from.array() > to.array()).any()) return;
  grid_.query(from, to, [&](Index k) { near.push_back(k); });
  sortUnique(near);
  for (const Index k : near) {
    const RestTriangle& t = surface_[static_cast<std::size_t>(k)];
    if (!segmentCrossesTriangle(p, q, t[0], t[1], t[2])) continue;
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    const double a = n.dot(t[0] - p), b = n.dot(q - p);
    along.push_back(b != 0 ? std::clamp(a / b, 0.0, 1.0) : 0);
  }
  std::ranges::sort(along);
}

bool BladeCourse::contains(const Vec3& point) const {
  if (!closed_) return false;
  Vec3 above = point;
  above.z() = std::max(high_.z(), point.z()) + 1e-3 * (1 + std::abs(high_.z()));
  std::vector<double> along;
  crossings(point, above, along);
  return along.size() % 2 == 1;
}

BladeCourse::Course BladeCourse::of(ConstVec3Span edge) const {
  Course course;
  bool inside = contains(edge.front());
  course.beginsInside = inside;
  std::vector<double> along;
  const auto add = [&](const Vec3& from, const Vec3& to) { course.inside += (to - from).norm(); };
  for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
    const Vec3 &p = edge[k], &q = edge[k + 1];
    crossings(p, q, along);
    const double before = course.length, length = (q - p).norm();
    course.length += length;
    Vec3 from = p;
    for (const double s : along) {
      const Vec3 at = p + s * (q - p);
      if (!course.first) {
        course.first = at;
        course.firstAt = before + s * length;
      }
      course.last = at;
      course.lastAt = before + s * length;
      if (inside) add(from, at);
      inside = closed_ ? !inside : true;
      from = at;
    }
    if (inside) add(from, q);
  }
  course.endsInside = inside;
  return course;
}

std::vector<Vec3> BladeCourse::partNear(ConstVec3Span edge, const Extent& extent, double margin) {
  std::vector<Vec3> part(edge.begin(), edge.end());
  if ((extent.beginsInside && extent.endsInside) || isRing(edge)) return part;
  const double from = extent.beginsInside ? 0 : extent.firstAt - margin;
  const double to = extent.endsInside ? extent.length : extent.lastAt + margin;
  part.clear();
  double along = 0;
  for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
    const double length = (edge[k + 1] - edge[k]).norm(), end = along + length;
    const auto at = [&](double s) {
      return Vec3(edge[k] + (s - along) / length * (edge[k + 1] - edge[k]));
    };
    if (end > from && along < to && length > 0) {
      if (part.empty()) part.push_back(along >= from ? edge[k] : at(from));
      part.push_back(end <= to ? edge[k + 1] : at(to));
    }
    along = end;
  }
  return part;
}

}  // namespace stroma
