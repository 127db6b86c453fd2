// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/seam_measure.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stroma {
namespace {

std::vector<Edge> seamEdges(const SimplicialComplex& complex) {
  std::vector<std::pair<Edge, bool>> sides;  // edge between vertices, wall or not
  std::vector<Edge> seam;
  const auto edge = [](Index a, Index b) { return Edge{std::min(a, b), std::max(a, b)}; };
  if (complex.dimension() == 2) {
    for (const SimplicialComplex::Facet f : complex.separatedFacets()) {
      const Triangle e = complex.facetVertices(f);
      seam.push_back(edge(e[0], e[1]));
    }
  } else {
    for (Index s = 0; s < static_cast<Index>(complex.surface().size()); ++s) {
      const Triangle& t = complex.surface()[static_cast<std::size_t>(s)];
      for (std::size_t i = 0; i < 3; ++i)
        sides.emplace_back(edge(complex.nodeVertex(t[i]), complex.nodeVertex(t[(i + 1) % 3])),
                           complex.isWall(s));
    }
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    // an edge that belongs to a wall as well as to the uncut surface
    for (std::size_t k = 1; k < sides.size(); ++k)
      if (sides[k].first == sides[k - 1].first) seam.push_back(sides[k].first);
  }
  std::sort(seam.begin(), seam.end());
  return seam;
}

double distanceToPath(const Vec3& x, ConstVec3Span path) {
  double least = (x - path[0]).norm();
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec3 along = path[k + 1] - path[k];
    const double length = along.squaredNorm();
    const double u = length > 0 ? std::clamp(along.dot(x - path[k]) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (x - path[k] - u * along).norm());
  }
  return least;
}

}  // namespace

std::vector<std::vector<Vec3>> seamLines(const SimplicialComplex& complex) {
  std::map<Index, std::vector<Index>> next;
  for (const Edge& e : seamEdges(complex)) {
    next[e[0]].push_back(e[1]);
    next[e[1]].push_back(e[0]);
  }
  std::vector<std::vector<Vec3>> lines;
  const auto follow = [&](Index start) {
    while (!next[start].empty()) {
      std::vector<Vec3> line = {complex.vertex(start)};
      const bool wasEnd = next[start].size() != 2;
      for (Index v = start;;) {
        const Index w = next[v].front();
        next[v].erase(next[v].begin());
        const std::size_t degree = next[w].size();
        next[w].erase(std::find(next[w].begin(), next[w].end(), v));
        line.push_back(complex.vertex(w));
        if (degree != 2 || w == start) break;
        v = w;
      }
      lines.push_back(std::move(line));
      if (!wasEnd) break;
    }
  };
  std::vector<Index> ends, all;
  for (const auto& [v, neighbours] : next) {
    all.push_back(v);
    if (neighbours.size() != 2) ends.push_back(v);
  }
  for (const Index v : ends) follow(v);
  for (const Index v : all) follow(v);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return lineLength(a) > lineLength(b); });
  return lines;
}

double lineLength(ConstVec3Span line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

Smoothness smoothness(ConstVec3Span line, ConstVec3Span path, double edge) {
  Smoothness result;
  if (line.size() < 2 || path.empty() || !(edge > 0)) return result;
  for (const Vec3& x : line)
    result.meanDeviation += distanceToPath(x, path) / edge / static_cast<double>(line.size());
  if (line.size() < 3) return result;
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const Vec3 u = line[k] - line[k - 1], w = line[k + 1] - line[k];
    result.meanTurning +=
        std::atan2(u.cross(w).norm(), u.dot(w)) / static_cast<double>(line.size() - 2);
  }
  return result;
}

}  // namespace stroma
