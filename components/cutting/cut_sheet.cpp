// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "components/cutting/exact_predicates.h"
#include "core/triangle.h"

namespace stroma {
namespace {

// Of the spacing.
constexpr double rowAdvance = 0.5, columnWidth = 0.75, leastMotion = 0.05, leastPose = 0.02,
                 cornerOff = 0.05, leastWidth = 0.1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double offSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double s = length2 > 0 ? std::clamp(d.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * d).norm();
}

// How far a pose has come from a row: the largest distance of its points from the row's line. A
// blade that slides back along itself has gone nowhere.
double motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double longest = 0;
  for (const Vec3& p : to) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < from.size(); ++k)
      nearest = std::min(nearest, offSegment(p, from[k], from[k + 1]));
    longest = std::max(longest, nearest);
  }
  return longest;
}

bool hasArea(const RestTriangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).squaredNorm() > 0; }

}  // namespace

bool isRing(ConstVec3Span polyline) {
  double length = 0;
  for (std::size_t k = 1; k < polyline.size(); ++k)
    length += (polyline[k] - polyline[k - 1]).norm();
  constexpr double nearly = 1e-9;
  return polyline.size() > 3 && (polyline.front() - polyline.back()).norm() <= nearly * length;
}

// === Sheet

CutSheet::CutSheet(double spacing, double longest) : spacing_(spacing), longest_(longest) {
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw std::invalid_argument("the spacing of a cut must be positive");
}

std::vector<Vec3> CutSheet::resampled(ConstVec3Span blade) const {
  std::vector<double> length(blade.size(), 0.0);
  for (std::size_t k = 1; k < blade.size(); ++k)
    length[k] = length[k - 1] + (blade[k] - blade[k - 1]).norm();
  std::vector<Vec3> points;
  points.reserve(at(columns_));
  std::size_t segment = 1;
  for (Index c = 0; c + 1 < columns_; ++c) {
    const double s = length.back() * c / (columns_ - 1);
    while (segment + 1 < blade.size() && length[segment] < s) ++segment;
    const double width = length[segment] - length[segment - 1];
    const double u = width > 0 ? (s - length[segment - 1]) / width : 0.0;
    points.push_back((1 - u) * blade[segment - 1] + u * blade[segment]);
  }
  points.push_back(closed_ ? points.front() : blade.back());
  return points;
}

// The pose since the last row that lies farthest off the straight way to `pose`; how many there are
// if none lies far off.
std::size_t CutSheet::cornerBefore(const std::vector<Vec3>& pose) const {
  std::size_t corner = since_.size();
  double farthest = cornerOff * spacing_;
  for (std::size_t s = 0; s < since_.size(); ++s)
    for (std::size_t k = 0; k < pose.size(); ++k)
      if (const double off = offSegment(since_[s][k], rows_.back()[k], pose[k]); off > farthest) {
        farthest = off;
        corner = s;
      }
  return corner;
}

// Whether nearly nothing lies between the last row and a pose: the blade has slid along itself.
bool CutSheet::isSlide(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const {
  double area = 0, length = 0;
  for (std::size_t k = 1; k < to.size(); ++k) {
    area += 0.5 * (from[k] - from[k - 1]).cross(to[k] - from[k - 1]).norm() +
            0.5 * (to[k] - from[k - 1]).cross(to[k - 1] - from[k - 1]).norm();
    length += (to[k] - to[k - 1]).norm();
  }
  return area < leastWidth * spacing_ * length;
}

// A blade that plunges along its own edge before it has cut anything sets in where it comes to.
void CutSheet::slideIn() {
  if (rows_.size() == 2 && isSlide(rows_[0], rows_[1])) rows_.erase(rows_.begin());
}

Index CutSheet::addPose(ConstVec3Span blade) {
  if (blade.size() < 2) throw std::invalid_argument("a blade needs two points at least");
  for (const Vec3& x : blade)
    if (!x.allFinite()) throw std::invalid_argument("a blade point is not finite");
  if (rows_.empty()) {
    double length = 0;
    for (std::size_t k = 1; k < blade.size(); ++k) length += (blade[k] - blade[k - 1]).norm();
    closed_ = isRing(blade);
    length = std::max(length, longest_);
    columns_ =
        std::max<Index>(2, 1 + static_cast<Index>(std::ceil(length / (columnWidth * spacing_))));
    rows_.push_back(resampled(blade));
    ++poses_;
    return 1;
  }
  std::vector<Vec3> pose = resampled(blade);
  if (motion(since_.empty() ? rows_.back() : since_.back(), pose) < leastPose * spacing_) return 0;
  ++poses_;
  const std::size_t before = rows_.size();
  if (const std::size_t corner = cornerBefore(pose); corner < since_.size()) {
    rows_.push_back(since_[corner]);
    slideIn();
    since_.erase(since_.begin(), since_.begin() + static_cast<std::ptrdiff_t>(corner) + 1);
  }
  // a hair less, so that poses at exactly this pitch are all taken
  const double moved = motion(rows_.back(), pose);
  if (moved < (rowAdvance - 1e-6) * spacing_) {
    since_.push_back(std::move(pose));
    return static_cast<Index>(rows_.size() - before);
  }
  const auto count =
      std::max<Index>(1, static_cast<Index>(std::ceil(moved / (columnWidth * spacing_))));
  const std::vector<Vec3> from = rows_.back();
  for (Index r = 1; r <= count; ++r) {
    std::vector<Vec3> row(from.size());
    const double u = static_cast<double>(r) / count;
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = r == count ? pose[k] : Vec3((1 - u) * from[k] + u * pose[k]);
    rows_.push_back(std::move(row));
  }
  since_.clear();
  slideIn();
  return static_cast<Index>(rows_.size() - before);
}

double CutSheet::distanceToFront(ConstVec3Span blade) const {
  return motion(rows_.back(), resampled(blade));
}

Index CutSheet::finish() {
  if (since_.empty() || motion(rows_.back(), since_.back()) < leastMotion * spacing_ ||
      isSlide(rows_.back(), since_.back()))
    return 0;
  rows_.push_back(since_.back());
  since_.clear();
  return 1;
}

std::vector<RestTriangle> CutSheet::strip(Index r) const {
  std::vector<RestTriangle> triangles;
  const auto &near = rows_[at(r)], &far = rows_[at(r + 1)];
  for (std::size_t k = 0; k + 1 < near.size(); ++k)
    for (const RestTriangle& t : {RestTriangle{near[k], near[k + 1], far[k + 1]},
                                  RestTriangle{near[k], far[k + 1], far[k]}})
      if (hasArea(t)) triangles.push_back(t);
  return triangles;
}

// === Window

SheetWindow::SheetWindow(const CutSheet& sheet, Index from, Index to, Index start, double skirt) {
  for (Index r = from; r < to; ++r)
    for (const RestTriangle& t : sheet.strip(r)) triangles.push_back(t);
  swept = triangles.size();

  // grid of the rows, prolonged by a skirt row in front (and behind where the blade set in) ...
  const std::size_t columns = at(sheet.columnCount());
  std::vector<std::vector<Vec3>> grid;
  for (Index r = from; r <= to; ++r) grid.emplace_back(sheet.row(r).begin(), sheet.row(r).end());
  const auto prolonged = [&](const std::vector<Vec3>& row, const std::vector<Vec3>& before) {
    Vec3 mean = Vec3::Zero();
    for (std::size_t k = 0; k < columns; ++k) mean += row[k] - before[k];
    mean /= static_cast<double>(columns);
    std::vector<Vec3> next(columns);
    for (std::size_t k = 0; k < columns; ++k) {
      Vec3 direction = row[k] - before[k];
      // a point about which the blade turns has no direction of its own
      if (direction.norm() < 0.2 * mean.norm()) direction = mean;
      const double norm = direction.norm();
      next[k] = row[k] + (norm > 0 ? skirt / norm : 0.0) * direction;
    }
    return next;
  };
  const bool behind = from == start;
  const std::vector<Vec3> ahead = prolonged(grid.back(), grid[grid.size() - 2]);
  if (behind) grid.insert(grid.begin(), prolonged(grid[0], grid[1]));
  grid.push_back(ahead);

  // ... and by a column at either end of an open blade
  if (!sheet.closed())
    for (std::vector<Vec3>& row : grid) {
      const Vec3 first = (row[0] - row[1]).normalized(),
                 last = (row[columns - 1] - row[columns - 2]).normalized();
      row.insert(row.begin(), row.front() + skirt * first);
      row.push_back(row.back() + skirt * last);
    }
  const std::size_t sweptRow = behind ? 1 : 0, sweptColumn = sheet.closed() ? 0 : 1;
  const std::size_t lastRow = grid.size() - 2, lastColumn = sweptColumn + columns - 1;
  const auto isSwept = [&](std::size_t r, std::size_t c) {
    return r >= sweptRow && r < lastRow && c >= sweptColumn && c < lastColumn;
  };
  const auto normalAt = [&](std::size_t r, std::size_t c) {
    return Vec3((grid[r + 1][c + 1] - grid[r][c]).cross(grid[r + 1][c] - grid[r][c + 1]));
  };
  const auto border = [&](const Vec3& a, const Vec3& b, const Vec3& normal) {
    if (normal.norm() > 0 && (b - a).norm() > 0) borders.push_back({a, b, normal.normalized()});
  };
  for (std::size_t r = 0; r + 1 < grid.size(); ++r)
    for (std::size_t c = 0; c + 1 < grid[r].size(); ++c) {
      if (!isSwept(r, c)) {
        for (const RestTriangle& t : {RestTriangle{grid[r][c], grid[r][c + 1], grid[r + 1][c + 1]},
                                      RestTriangle{grid[r][c], grid[r + 1][c + 1], grid[r + 1][c]}})
          if (hasArea(t)) triangles.push_back(t);
        continue;
      }
      const Vec3 normal = normalAt(r, c);
      if (behind && r == sweptRow) border(grid[r][c], grid[r][c + 1], normal);
      if (r + 1 == lastRow) border(grid[r + 1][c], grid[r + 1][c + 1], normal);
      if (!sheet.closed() && c == sweptColumn) border(grid[r][c], grid[r + 1][c], normal);
      if (!sheet.closed() && c + 1 == lastColumn)
        border(grid[r][c + 1], grid[r + 1][c + 1], normal);
    }

  low.setConstant(std::numeric_limits<double>::max());
  high = -low;
  for (const RestTriangle& t : triangles) {
    boxes.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])});
    low = low.cwiseMin(boxes.back().low);
    high = high.cwiseMax(boxes.back().high);
  }
}

SheetWindow::Nearest SheetWindow::nearest(const Vec3& x, double reach, std::size_t count) const {
  double least = reach * reach;
  Nearest found;
  for (std::size_t k = 0; k < count; ++k) {
    if (((x - boxes[k].low).array() < -reach).any() || ((x - boxes[k].high).array() > reach).any())
      continue;
    const RestTriangle& t = triangles[k];
    const double d = nearestOnTriangle({t[0], t[1], t[2]}, x).distance2;
    if (d > least) continue;
    least = d;
    const double above = (t[1] - t[0]).cross(t[2] - t[0]).normalized().dot(x - t[0]);
    found = {std::sqrt(d), std::sqrt(std::max(0.0, d - above * above))};
  }
  return found;
}

Index SheetWindow::crossings(const Vec3& p, const Vec3& q, std::size_t count) const {
  const Vec3 lo = p.cwiseMin(q), hi = p.cwiseMax(q);
  Index crossed = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // touching boxes are kept: the tie rule decides about points on a triangle
    if ((hi.array() < boxes[k].low.array()).any() || (lo.array() > boxes[k].high.array()).any())
      continue;
    const RestTriangle& t = triangles[k];
    if (segmentCrossesTriangle(p, q, t[0], t[1], t[2])) ++crossed;
  }
  return crossed;
}

SheetWindow::Crossing SheetWindow::crossing(const Vec3& p, const Vec3& q) const {
  const Vec3 lo = p.cwiseMin(q), hi = p.cwiseMax(q);
  Crossing first;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    if ((hi.array() < boxes[k].low.array()).any() || (lo.array() > boxes[k].high.array()).any())
      continue;
    const RestTriangle& t = triangles[k];
    if (!segmentCrossesTriangle(p, q, t[0], t[1], t[2])) continue;
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    const double dp = n.dot(p - t[0]), dq = n.dot(q - t[0]);
    const double where = dp != dq ? std::clamp(dp / (dp - dq), 0.0, 1.0) : 0.5;
    if (first.weight < 0 || where < first.weight) first = {where, k < swept};
  }
  return first;
}

double SheetWindow::exit(const Vec3& p, const Vec3& q) const {
  constexpr double overlap = 0.1;  // borders meet at an angle
  double last = -1;
  for (const Border& s : borders) {
    const Vec3 along = s.b - s.a, across = along.cross(s.normal);
    const double dp = across.dot(p - s.a), dq = across.dot(q - s.a);
    if ((dp > 0) == (dq > 0)) continue;
    const double where = dp / (dp - dq);
    const Vec3 x = p + where * (q - p);
    const double u = along.dot(x - s.a) / along.squaredNorm();
    if (u < -overlap || u > 1 + overlap) continue;
    // on the other side of a thin curl of the sheet
    if (std::abs(s.normal.dot(x - s.a)) > (q - p).norm()) continue;
    last = std::max(last, where);
  }
  return last;
}

}  // namespace stroma
