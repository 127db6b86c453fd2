// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/sorted_ids.h"

namespace stroma {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double leastSplit = 0.05;  // shortest edge that a split at a border leaves, in spacings

}  // namespace

Cutter::Cutter(SimplicialComplex& complex, double spacing, const CutterOptions& options)
    : complex_(complex),
      spacing_(spacing > 0 ? spacing : complex.meanEdgeLength()),
      longestEdge_(complex.longestEdge()),
      options_(options),
      grid_(spacing_) {
  // room to grow, so that no cut pays for moving the whole body
  const std::size_t room = at(complex.vertexCount()) * 5 / 4 + 4096;
  grid_.reserve(room);
  onSheet_.reserve(room);
  onSwept_.reserve(room);
  inside_.reserve(room);
  seen_.reserve(at(complex.simplexCount()) * 5 / 4 + 4096);
  seen_.assign(at(complex.simplexCount()), -1);
  for (Index v = 0; v < complex.vertexCount(); ++v) addVertex(v);
}

void Cutter::addVertex(Index v) {
  grid_.insert(v, complex_.vertex(v));
  onSheet_.push_back(-1);
  onSwept_.push_back(-1);
  inside_.push_back(isWithin(v) ? 1 : 0);
}

bool Cutter::isWithin(Index v) const {
  const auto isOutside = [&](Index t) {
    for (int i = 0; i < complex_.corners(); ++i)
      if (complex_.simplex(t)[at(i)] != v && complex_.across({t, i}) < 0) return true;
    return false;
  };
  return complex_.dimension() == 3 && std::ranges::none_of(complex_.star(v), isOutside);
}

SurfaceEdit Cutter::advance(ConstVec3Span blade, double longest) {
  if (!sheet_) {
    begin(blade, longest);
    return {};
  }
  if (inOwnSlit(blade)) {
    withinSlit_.assign(blade.begin(), blade.end());
    return {};
  }
  std::vector<RestTriangle> swept;
  if (!withinSlit_.empty() && sheet_->distanceToFront(withinSlit_) > spacing_) {
    const std::vector<Vec3> from = std::move(withinSlit_);
    end(swept);
    begin(from, longest);
  }
  withinSlit_.clear();
  sweepTo(blade, swept);
  return takeEdit(swept);
}

void Cutter::begin(ConstVec3Span blade, double longest) {
  auto sheet = std::make_unique<CutSheet>(spacing_, longest);
  sheet->addPose(blade);
  sheet_ = std::move(sheet);
  slit_.reset();
  withinSlit_.clear();
  slitEnd_ = start_ = 0;
  setIn_ = step_ + 1;
  ++poses_;
}

bool Cutter::inOwnSlit(ConstVec3Span blade) {
  constexpr Index longest = 24;   // rows that are remembered
  constexpr double width = 0.15;  // of the spacing, to each side
  const Index last = sheet_->rowCount() - 1;
  if (last < 1) return false;
  if (slitEnd_ != last) {
    slit_ = std::make_unique<SheetWindow>(*sheet_, std::max<Index>(0, last - longest), last, -1,
                                          spacing_);
    slitEnd_ = last;
  }
  return std::ranges::all_of(blade, [&](const Vec3& x) {
    return slit_->nearest(x, width * spacing_, slit_->swept).distance <= width * spacing_;
  });
}

void Cutter::sweepTo(ConstVec3Span blade, std::vector<RestTriangle>& sheetTriangles) {
  const Index before = sheet_->rowCount(), known = sheet_->poseCount();
  sheet_->addPose(blade);
  poses_ += sheet_->poseCount() - known;
  for (Index row = before; row < sheet_->rowCount(); ++row)
    cutStrip(row, false, false, sheetTriangles);
}

SurfaceEdit Cutter::takeEdit(std::span<const RestTriangle> sheetTriangles) {
  SurfaceEdit edit = complex_.takeEdit();
  edit.cutFacets.insert(edit.cutFacets.end(), sheetTriangles.begin(), sheetTriangles.end());
  return edit;
}

SurfaceEdit Cutter::finish(ConstVec3Span blade) {
  if (!sheet_) return {};
  std::vector<RestTriangle> swept;
  if (!blade.empty() && !inOwnSlit(blade)) sweepTo(blade, swept);
  end(swept);
  return takeEdit(swept);
}

void Cutter::end(std::vector<RestTriangle>& swept) {
  const bool moved = sheet_->finish() > 0;
  if (sheet_->rowCount() > 1) {
    if (moved) cutStrip(sheet_->rowCount() - 1, false, false, swept);
    // what was refused while the cut was shorter
    const std::vector<Index> rows = std::move(refusedRows_);
    refusedRows_.clear();
    for (const Index row : rows)
      if (row > start_) cutStrip(row, false, true, swept);
    cutStrip(sheet_->rowCount() - 1, true, false, swept);
  }
  sheet_.reset();
  waiting_.clear();
  refusedRows_.clear();
}

// A strip that has been cut before, to the bit, needs nothing: a cut repeated is no cut.
std::uint64_t Cutter::stripKey(Index row, bool first, bool last) const {
  std::uint64_t key = 14695981039346656037ULL;
  const auto add = [&](std::uint64_t bits) { key = (key ^ bits) * 1099511628211ULL; };
  add((first ? 2U : 0U) + (last ? 1U : 0U));
  for (Index r = row - 1; r <= row; ++r)
    for (const Vec3& x : sheet_->row(r))
      for (int d = 0; d < 3; ++d) {
        // both halves, as a product modulo 2^64 carries upwards only
        const auto bits = std::bit_cast<std::uint64_t>(x[d]);
        add(bits);
        add(bits >> 32U);
      }
  return key;
}

void Cutter::cutStrip(Index row, bool last, bool replay,
                      std::vector<RestTriangle>& sheetTriangles) {
  ++step_;
  firstStep_ = std::max(setIn_, step_ - windowRows);
  if (row >= 2) {
    // a blade that turns back begins a new sheet: sides are counted by crossings
    double along = 0;
    for (std::size_t k = 0; k < sheet_->row(row).size(); ++k)
      along += (sheet_->row(row)[k] - sheet_->row(row - 1)[k])
                   .dot(sheet_->row(row - 1)[k] - sheet_->row(row - 2)[k]);
    if (along < 0) start_ = std::max(start_, row - 1);
  }
  const bool first = row == start_ + 1;
  if (!replay && !done_.insert(stripKey(row, first, last)).second) return;
  if (complex_.dimension() == 2 && !replay && !last)
    for (const RestTriangle& t : sheet_->strip(row - 1)) sheetTriangles.push_back(t);

  if (!options_.subdivide) {
    const SheetWindow strip(*sheet_, row - 1, row, -1, options_.skirt * spacing_);
    findNear(strip);
    std::vector<Facet> facets = facetsBetweenCentroids(strip);
    complex_.separate(facets, last);
    std::erase_if(facets, [&](Facet f) { return complex_.isFree(f); });
    waiting_ = std::move(facets);
    return;
  }

  const SheetWindow window(*sheet_, std::max(start_, row - windowRows), row, start_,
                           options_.skirt * spacing_);
  if (window.swept == 0) return;
  findNear(window);
  for (const Index v : nearVertices_) tag(v, window);
  conform(window, first, last);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Edge> stuck;
    const std::vector<Facet> facets = facetsToSeparate(window);
    const Index accepted =
        complex_.separate(facets, last || replay, round + 1 < rounds ? &stuck : nullptr);
    if (stuck.empty()) {
      if (accepted < static_cast<Index>(facets.size())) refusedRows_.push_back(row);
      return;
    }
    splitStuck(stuck);
  }
}

// === What is near

void Cutter::findNear(const SheetWindow& window) {
  seen_.resize(at(complex_.simplexCount()), -1);
  near_.clear();
  nearVertices_.clear();
  const Vec3 margin = Vec3::Constant(longestEdge_);
  const Vec3 low = window.low - margin, high = window.high + margin;
  grid_.query(low, high, [&](Index v) {
    const Vec3& x = complex_.vertex(v);
    if ((x.array() < low.array()).any() || (x.array() > high.array()).any()) return;
    for (const Index t : complex_.star(v)) {
      if (seen_[at(t)] == step_) continue;
      seen_[at(t)] = step_;
      Vec3 lo = x, hi = x;
      for (int i = 0; i < complex_.corners(); ++i) {
        const Vec3& y = complex_.vertex(complex_.simplex(t)[at(i)]);
        lo = lo.cwiseMin(y);
        hi = hi.cwiseMax(y);
      }
      if ((lo.array() > window.high.array()).any() || (hi.array() < window.low.array()).any())
        continue;
      near_.push_back(t);
    }
  });
  std::sort(near_.begin(), near_.end());
  for (const Index t : near_)
    for (int i = 0; i < complex_.corners(); ++i)
      nearVertices_.push_back(complex_.simplex(t)[at(i)]);
  sortUnique(nearVertices_);
}

void Cutter::tag(Index v, const SheetWindow& window) {
  const CutTolerance& allowed = isInside(v) ? options_.inside : options_.surface;
  const double off = allowed.snap * spacing_, beyond = allowed.overshoot * spacing_;
  const Vec3& x = complex_.vertex(v);
  if (window.nearest(x, off, window.triangles.size()).distance > off) return;
  onSheet_[at(v)] = step_;
  const SheetWindow::Nearest swept = window.nearest(x, std::hypot(off, beyond), window.swept);
  if (swept.distance <= off || (std::isfinite(swept.distance) && swept.beyond <= beyond))
    onSwept_[at(v)] = step_;
}

// === Splitting

// Edges that cross the sheet with both ends off it, longest first: that leaves the better
// triangles. Returns whether one of them crosses the swept part and not the skirt only.
bool Cutter::findCrossedEdges(const SheetWindow& window, std::vector<Split>& splits) const {
  std::vector<Edge> edges;
  for (const Index t : near_)
    for (int i = 0; i < complex_.corners(); ++i)
      for (int j = 0; j < i; ++j) {
        const Index a = complex_.simplex(t)[at(i)], b = complex_.simplex(t)[at(j)];
        if (!onSheet(a) && !onSheet(b)) edges.push_back({std::min(a, b), std::max(a, b)});
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  bool swept = false;
  for (const Edge& e : edges) {
    const SheetWindow::Crossing c = window.crossing(complex_.vertex(e[0]), complex_.vertex(e[1]));
    if (c.weight < 0) continue;
    swept = swept || c.swept;
    splits.push_back({e, c.weight, (complex_.vertex(e[1]) - complex_.vertex(e[0])).norm()});
  }
  std::stable_sort(splits.begin(), splits.end(),
                   [](const Split& a, const Split& b) { return a.length > b.length; });
  return swept;
}

// Is there a facet on the sheet at this edge which is not cut yet?
bool Cutter::isUncutAt(Index v, Index w) const {
  for (const Index t : complex_.star(v)) {
    const auto& s = complex_.simplex(t);
    if (std::find(s.begin(), s.end(), w) == s.end()) continue;
    for (int i = 0; i < complex_.corners(); ++i) {
      if (s[at(i)] == v || s[at(i)] == w || complex_.isFree({t, i})) continue;
      bool all = true;
      for (const Index u : complex_.facetVertices({t, i})) all = all && (u < 0 || onSheet(u));
      if (all) return true;
    }
  }
  return false;
}

// Edges along the sheet that leave the swept part where it has not been cut yet.
void Cutter::findBorderEdges(const SheetWindow& window, bool exact, std::vector<Split>& splits) {
  const double least = leastSplit * spacing_, inner = options_.inside.lag * spacing_,
               outer = exact ? least : options_.surface.lag * spacing_;
  for (std::size_t k = 0; k < nearVertices_.size(); ++k) {
    const Index v = nearVertices_[k];
    if (!onSwept(v)) continue;
    for (const Index t : complex_.star(v))
      for (int i = 0; i < complex_.corners(); ++i) {
        const Index w = complex_.simplex(t)[at(i)];
        if (!onSheet(w) || onSwept(w)) continue;
        const double where = window.exit(complex_.vertex(v), complex_.vertex(w));
        const double length = (complex_.vertex(w) - complex_.vertex(v)).norm();
        // an edge that leads inwards has a say in where the incision ends on the outside
        const double reach = isInside(v) && isInside(w) ? inner : outer;
        if (where * length <= reach || (1 - where) * length < least) continue;
        if (isUncutAt(v, w)) splits.push_back({{v, w}, where, length});
      }
  }
  std::sort(splits.begin(), splits.end(),
            [](const Split& a, const Split& b) { return a.edge < b.edge; });
  splits.erase(std::unique(splits.begin(), splits.end(),
                           [](const Split& a, const Split& b) { return a.edge == b.edge; }),
               splits.end());
}

Index Cutter::split(Edge edge, double weight) {
  const Index v = complex_.splitEdge(edge[0], edge[1], weight);
  addVertex(v);
  nearVertices_.push_back(v);
  onSheet_[at(v)] = step_;
  return v;
}

// Where everything has been cut before, nothing is split: cutting twice is cutting once.
void Cutter::conform(const SheetWindow& window, bool first, bool last) {
  // the two ends of a cut are made exact, what lies between is passed over by the next strips
  const bool exact = first || last;
  std::vector<Split> crossed, border;
  const bool news = findCrossedEdges(window, crossed);
  if (!news && !last) {
    findBorderEdges(window, exact, border);
    if (border.empty()) return;
    border.clear();
  }
  for (const Split& s : crossed) tag(split(s.edge, s.weight), window);
  findBorderEdges(window, exact, border);
  for (const Split& s : border)
    if (!isCrowded(s)) onSwept_[at(split(s.edge, s.weight))] = step_;
}

// Is there a vertex that is cut already right beside the split, which would leave a needle? Then
// the border goes by way of that one; the surface is split all the same, as one sees it.
bool Cutter::isCrowded(const Split& s) const {
  const auto [p, q] = s.edge;
  if (!isInside(p) || !isInside(q)) return false;
  const Vec3 x = (1 - s.weight) * complex_.vertex(p) + s.weight * complex_.vertex(q);
  return std::ranges::any_of(complex_.star(p), [&](Index t) {
    const auto& simplex = complex_.simplex(t);
    if (std::find(simplex.begin(), simplex.end(), q) == simplex.end()) return false;
    return std::ranges::any_of(simplex, [&](Index v) {
      return v >= 0 && v != p && v != q && onSwept(v) &&
             (complex_.vertex(v) - x).norm() < leastSplit * spacing_;
    });
  });
}

void Cutter::splitStuck(std::span<const Edge> edges) {
  constexpr double middle = 0.5;
  for (const Edge& e : edges) onSwept_[at(split(e, middle))] = step_;
}

// === Separating

bool Cutter::touched(Index t) const {
  for (int i = 0; i < complex_.corners(); ++i) {
    const Index v = complex_.simplex(t)[at(i)];
    if (!onSheet(v)) return false;
  }
  return true;
}

Vec3 Cutter::sidePoint(Index t) const {
  for (int i = 0; i < complex_.corners(); ++i) {
    const Index v = complex_.simplex(t)[at(i)];
    if (!onSheet(v)) return complex_.vertex(v);
  }
  return complex_.centroid(t);
}

std::vector<SimplicialComplex::Facet> Cutter::facetsToSeparate(const SheetWindow& window) {
  std::vector<Facet> facets;
  for (const Index v : nearVertices_) {
    if (!onSwept(v)) continue;
    for (const Index t : complex_.star(v))
      for (int i = 0; i < complex_.corners(); ++i) {
        const Facet f{t, i};
        const Index n = complex_.across(f);
        if (n < t || complex_.isFree(f)) continue;
        bool all = true;
        Index lowest = v;
        for (const Index w : complex_.facetVertices(f)) {
          if (w < 0) continue;
          all = all && onSwept(w);
          lowest = std::min(lowest, w);
        }
        if (!all || lowest != v || complex_.simplex(t)[at(i)] == v) continue;
        if (window.crossings(sidePoint(t), sidePoint(n), window.triangles.size()) % 2 == 1)
          facets.push_back(f);
      }
  }
  keepTouched(facets);
  return facets;
}

std::vector<SimplicialComplex::Facet> Cutter::facetsBetweenCentroids(const SheetWindow& strip) {
  std::vector<Facet> facets = waiting_;
  for (const Index t : near_)
    for (int i = 0; i < complex_.corners(); ++i) {
      const Facet f{t, i};
      const Index n = complex_.across(f);
      if (n < t || complex_.isFree(f)) continue;
      if (strip.crossings(complex_.centroid(t), complex_.centroid(n), strip.swept) % 2 == 1)
        facets.push_back(f);
    }
  return facets;
}

// Leaves facets closed that would free a group of simplices with all vertices on the sheet, or a
// chip.
void Cutter::keepTouched(std::vector<Facet>& facets) {
  std::vector<std::pair<Index, int>> cut;
  for (const Facet f : facets) {
    const Index n = complex_.across(f);
    cut.emplace_back(f.simplex, f.corner);
    for (int i = 0; i < complex_.corners(); ++i)
      if (complex_.across({n, i}) == f.simplex) cut.emplace_back(n, i);
  }
  std::sort(cut.begin(), cut.end());
  const auto isCut = [&](Index t, int i) {
    return std::binary_search(cut.begin(), cut.end(), std::pair(t, i));
  };
  std::vector<Index> kept, group;
  const double chip = options_.smallestPiece * spacing_ * spacing_ * spacing_;
  const auto closesGroup = [&](Index seed) {
    group.assign(1, seed);
    bool onSheetOnly = true;
    double size = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      onSheetOnly = onSheetOnly && touched(group[k]);
      if (complex_.dimension() == 3) size += complex_.volume(group[k]);
      if (!onSheetOnly && (complex_.dimension() == 2 || size > chip)) return false;
      for (int i = 0; i < complex_.corners(); ++i) {
        const Facet f{group[k], i};
        const Index n = complex_.across(f);
        if (n < 0 || complex_.isFree(f) || isCut(group[k], i)) continue;
        if (std::find(group.begin(), group.end(), n) == group.end()) group.push_back(n);
      }
    }
    return true;
  };
  for (const auto& [t, i] : cut)
    if (closesGroup(t)) kept.insert(kept.end(), group.begin(), group.end());
  if (kept.empty()) return;
  std::sort(kept.begin(), kept.end());
  const auto isKept = [&](Index t) { return std::binary_search(kept.begin(), kept.end(), t); };
  std::erase_if(facets, [&](Facet f) { return isKept(f.simplex) || isKept(complex_.across(f)); });
}

}  // namespace stroma
