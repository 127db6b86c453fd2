// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/surface_check.h"

#include <algorithm>
#include <functional>

namespace stroma {
namespace {

using Findings = std::vector<SurfaceFinding>;

std::string name(const Edge& e) {
  return "edge " + std::to_string(e[0]) + "-" + std::to_string(e[1]);
}

void checkIndices(ConstVec3Span x, TriangleSpan triangles, Findings& out) {
  if (x.empty() || triangles.empty())
    out.push_back({SurfaceFault::empty,
                   -1,
                   {-1, -1},
                   x.empty() ? "the mesh has no vertex" : "the mesh has no triangle"});
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!x[i].allFinite())
      out.push_back({SurfaceFault::nonFinitePosition,
                     -1,
                     {static_cast<Index>(i), -1},
                     "vertex " + std::to_string(i) + " is not at a finite position"});
  const auto count = static_cast<Index>(x.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (const Index v : triangles[f])
      if (v < 0 || v >= count) {
        out.push_back({SurfaceFault::indexOutOfRange,
                       static_cast<Index>(f),
                       {v, -1},
                       "triangle " + std::to_string(f) + " uses vertex " + std::to_string(v) +
                           ", the mesh has vertices 0 to " + std::to_string(count - 1)});
        break;
      }
}

// Degenerate triangles.
void checkShapes(ConstVec3Span x, TriangleSpan triangles, Findings& out) {
  Findings flat;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const auto index = static_cast<Index>(f);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      const Index twice = t[0] == t[1] || t[0] == t[2] ? t[0] : t[1];
      out.push_back(
          {SurfaceFault::repeatedVertex,
           index,
           {twice, -1},
           "triangle " + std::to_string(f) + " uses vertex " + std::to_string(twice) + " twice"});
      continue;
    }
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (x[t[(k + 1) % 3]] - x[t[k]]).squaredNorm());
    if (!(vectorArea(x, t).norm() > 1e-12 * longest))
      flat.push_back({SurfaceFault::zeroArea,
                      index,
                      {-1, -1},
                      "triangle " + std::to_string(f) + " (vertices " + std::to_string(t[0]) +
                          ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) +
                          ") has no area"});
  }
  out.insert(out.end(), flat.begin(), flat.end());
}

struct HalfEdge {
  Edge edge;  // smaller node first
  Index triangle;
  bool forward;
};

std::vector<HalfEdge> sortedHalfEdges(TriangleSpan triangles) {
  std::vector<HalfEdge> all;
  all.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      all.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Index>(f), a < b});
    }
  }
  std::sort(all.begin(), all.end(), [](const HalfEdge& p, const HalfEdge& q) {
    return p.edge != q.edge ? p.edge < q.edge : p.triangle < q.triangle;
  });
  return all;
}

void checkEdges(TriangleSpan triangles, Findings& out) {
  Findings branching, turned, open;
  const std::vector<HalfEdge> all = sortedHalfEdges(triangles);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].edge == all[begin].edge) ++end;
    const HalfEdge& first = all[begin];
    if (end - begin > 2)
      branching.push_back({SurfaceFault::nonManifoldEdge, first.triangle, first.edge,
                           name(first.edge) + " has " + std::to_string(end - begin) +
                               " triangles, a surface has at most two"});
    else if (end - begin == 1)
      open.push_back({SurfaceFault::openRim, first.triangle, first.edge,
                      name(first.edge) + " of triangle " + std::to_string(first.triangle) +
                          " is on an open rim"});
    else if (first.forward == all[begin + 1].forward)
      turned.push_back({SurfaceFault::inconsistentOrientation, all[begin + 1].triangle, first.edge,
                        "triangles " + std::to_string(first.triangle) + " and " +
                            std::to_string(all[begin + 1].triangle) + " at " + name(first.edge) +
                            " are oriented against each other"});
  }
  for (const Findings* group : {&branching, &turned, &open})
    out.insert(out.end(), group->begin(), group->end());
}

void checkVertices(ConstVec3Span x, TriangleSpan triangles, Findings& out) {
  std::vector<bool> used(x.size(), false);
  for (const Triangle& t : triangles)
    for (const Index v : t) used[v] = true;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!used[i])
      out.push_back({SurfaceFault::unreferencedVertex,
                     -1,
                     {static_cast<Index>(i), -1},
                     "vertex " + std::to_string(i) + " belongs to no triangle"});
}

void checkVolume(ConstVec3Span x, TriangleSpan triangles, Findings& out) {
  const double volume = enclosedVolume(x, triangles);
  const double area = surfaceArea(x, triangles);
  if (volume * volume <= 1e-18 * area * area * area)
    out.push_back({SurfaceFault::noVolume, -1, {-1, -1}, "the surface encloses no volume"});
  else if (volume < 0)
    out.push_back({SurfaceFault::insideOut,
                   -1,
                   {-1, -1},
                   "the surface is turned inside out: its triangles face inwards"});
}

std::string summary(const Findings& findings, const std::function<bool(SurfaceFault)>& isHarmless) {
  std::string text;
  std::size_t more = 0;
  for (const SurfaceFinding& f : findings) {
    if (isHarmless(f.fault)) continue;
    if (text.empty())
      text = f.text;
    else
      ++more;
  }
  if (more == 0) return text;
  return text + " (and " + std::to_string(more) +
         (more == 1 ? " more finding)" : " more findings)");
}

bool enclosesNothing(SurfaceFault f) {
  return f == SurfaceFault::repeatedVertex || f == SurfaceFault::zeroArea ||
         f == SurfaceFault::unreferencedVertex;
}

}  // namespace

std::vector<SurfaceFinding> checkSurface(ConstVec3Span x, TriangleSpan triangles) {
  Findings out;
  checkIndices(x, triangles, out);
  if (!out.empty()) return out;
  checkShapes(x, triangles, out);
  checkEdges(triangles, out);
  const bool closed = std::all_of(out.begin(), out.end(),
                                  [](const SurfaceFinding& f) { return enclosesNothing(f.fault); });
  checkVertices(x, triangles, out);
  if (closed) checkVolume(x, triangles, out);
  return out;
}

std::string whyNotClosed(ConstVec3Span x, TriangleSpan triangles) {
  return summary(checkSurface(x, triangles), enclosesNothing);
}

std::string whyNotSheet(ConstVec3Span x, TriangleSpan triangles) {
  return summary(checkSurface(x, triangles), [](SurfaceFault f) {
    return f == SurfaceFault::openRim || f == SurfaceFault::unreferencedVertex;
  });
}

}  // namespace stroma
