// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/incision_trace.h"

#include <algorithm>

#include "components/cutting/cut_sheet.h"
#include "components/cutting/seam_measure.h"

namespace stroma {

void IncisionTrace::add(const Tool& tool, ConstVec3Span edge, const BladeCourse::Course& course) {
  constexpr double least = 0.1;  // of an edge: nearer points only add up noise
  const auto append = [&](std::vector<Vec3>& path, const std::optional<Vec3>& at) {
    if (at && (path.empty() || (path.back() - *at).norm() > least * meanEdge_)) path.push_back(*at);
  };
  std::vector<Vec3>&other = paths_[paths_.size() - 2], &own = paths_.back();
  const std::span<const Vec3> shape = tool.edge();
  if (isRing(shape)) {
    constexpr double whole = 0.99;
    if (own.empty() && course.inside > whole * course.length) own.assign(edge.begin(), edge.end());
    return;
  }
  const bool twoSided = shape.back().z() > 0;  // it ends at the handle again
  if (!course.beginsInside) append(twoSided ? other : own, course.first);
  if (twoSided && !course.endsInside) append(own, course.last);
}

IncisionTrace::Measure IncisionTrace::measure(const SimplicialComplex& complex) const {
  constexpr double onPath = 0.3;  // edges; a cut right through leaves seams farther off as well
  Measure sum;
  const auto lines = seamLines(complex);
  std::vector<char> measured(lines.size(), 0);  // a blade may go along a line twice
  for (std::size_t pair = 0; pair + 1 < paths_.size(); pair += 2) {
    std::vector<Vec3> path(paths_[pair].rbegin(), paths_[pair].rend());
    path.insert(path.end(), paths_[pair + 1].begin(), paths_[pair + 1].end());
    if (path.size() < 2) continue;
    sum.path += lineLength(path);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const Smoothness own = smoothness(lines[k], path, meanEdge_);
      if (measured[k] || own.meanDeviation > onPath) continue;
      measured[k] = 1;
      const double length = lineLength(lines[k]);
      sum.length += length;
      sum.turning += length * own.meanTurning;
      sum.deviation += length * own.meanDeviation;
    }
  }
  if (sum.length > 0) {
    sum.turning /= sum.length;
    sum.deviation /= sum.length;
  }
  return sum;
}

void IncisionTrace::save(StateWriter& writer) const {
  std::vector<double> lengths;
  std::vector<Vec3> points;
  for (const auto& path : paths_) {
    lengths.push_back(static_cast<double>(path.size()));
    points.insert(points.end(), path.begin(), path.end());
  }
  writer.write("paths", std::span<const double>(lengths));
  writer.write("pathPoints", ConstVec3Span(points));
}

void IncisionTrace::restore(StateReader& reader) {
  std::vector<double> lengths(reader.count<double>("paths"));
  std::vector<Vec3> points(reader.count<double>("pathPoints") / 3);
  paths_.assign(2, {});
  if (!reader.read("paths", std::span(lengths)) || !reader.read("pathPoints", Vec3Span(points)))
    return;
  paths_.clear();
  auto from = points.begin();
  for (const double length : lengths) {
    const auto to = from + std::min(static_cast<std::ptrdiff_t>(length), points.end() - from);
    paths_.emplace_back(from, to);
    from = to;
  }
}

}  // namespace stroma
