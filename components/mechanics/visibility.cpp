// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/visibility.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/parallel.h"
#include "core/sorted_ids.h"

namespace stroma {
namespace {

// Growing balls in which others are looked for, in support radii.
constexpr std::array<double, 3> searchRadii = {1, 1.6, 2.5};

struct Ball {
  Vec3 centre;
  double radius;
};

Ball ballAround(const RestTriangle& t) {
  const Vec3 centre = (t[0] + t[1] + t[2]) / 3;
  return {centre, std::sqrt(std::max({(t[0] - centre).squaredNorm(), (t[1] - centre).squaredNorm(),
                                      (t[2] - centre).squaredNorm()}))};
}

double reachOf(ConstVec3Span X, const Neighbourhoods& n, Index i) {
  double squared = 0;
  for (const Index j : n.neighboursOf(i)) squared = std::max(squared, (X[j] - X[i]).squaredNorm());
  return std::sqrt(squared);
}

// From a point to a particle that could carry it.
double carryingDistance(const Neighbourhoods& n, Index i, const Vec3& offset) {
  return n.axes.empty() ? offset.norm() : n.distance(i, offset);
}

}  // namespace

VisibilitySearch::VisibilitySearch(ConstVec3Span X, const Neighbourhoods& n)
    : X_(X), tree_(X), radius_(n.radii), reach_(X.size()) {
  parallelFor(n.particleCount(), [&](Index i) { reach_[i] = reachOf(X, n, i); });
  double sum = 0;
  for (const double r : reach_) sum += r;
  usualReach_ = 1.5 * sum / static_cast<double>(std::max<std::size_t>(X.size(), 1));
  for (Index i = 0; i < n.particleCount(); ++i)
    if (reach_[i] > usualReach_) long_.push_back(i);
}

FacetBoxes::FacetBoxes(std::span<const RestTriangle> facets) {
  for (const RestTriangle& t : facets) {
    Eigen::AlignedBox3d box(t[0]);
    box.extend(t[1]).extend(t[2]);
    boxes_.push_back(box);
    all_.extend(box);
  }
  if (boxes_.empty()) return;
  all_.sizes().maxCoeff(&axis_);
  for (const auto& box : boxes_) longest_ = std::max(longest_, box.sizes()[axis_]);
  std::ranges::sort(boxes_, {}, [this](const auto& box) { return box.min()[axis_]; });
}

bool FacetBoxes::mayCross(const Vec3& a, const Vec3& b) const {
  const Eigen::AlignedBox3d segment(a.cwiseMin(b), a.cwiseMax(b));
  if (!all_.intersects(segment)) return false;
  const auto low = [this](const auto& box) { return box.min()[axis_]; };
  for (auto box = std::ranges::lower_bound(boxes_, low(segment) - longest_, {}, low);
       box != boxes_.end() && low(*box) <= segment.max()[axis_]; ++box)
    if (box->intersects(segment)) return true;
  return false;
}

bool losesSight(const Vec3& eye, std::span<const Index> of, ConstVec3Span X,
                const FacetBoxes& facets, const CutBarrier& barrier) {
  std::vector<Vec3> ends;
  for (const Index i : of)
    if (facets.mayCross(eye, X[i])) ends.push_back(X[i]);
  if (ends.empty()) return false;
  std::vector<char> blocked(ends.size(), 0);
  barrier.block(eye, ends, blocked);
  return std::ranges::find(blocked, 1) != blocked.end();
}

std::vector<Index> VisibilitySearch::around(std::span<const RestTriangle> facets,
                                            double reach) const {
  std::vector<Index> ids;
  std::vector<std::pair<Index, double>> found;
  marks_.clear(X_.size());
  for (const RestTriangle& facet : facets) {
    const Ball ball = ballAround(facet);
    tree_.within(ball.centre, ball.radius + reach, found);
    for (const auto& [id, squared] : found)
      if (marks_.mark(id)) ids.push_back(id);
  }
  return ids;
}

std::vector<Index> VisibilitySearch::blockedRows(const Neighbourhoods& n,
                                                 std::span<const RestTriangle> facets,
                                                 const FacetBoxes& boxes,
                                                 const CutBarrier& barrier) const {
  std::vector<Index> rows;
  if (facets.empty()) return rows;
  for (std::vector<Index> candidates : {around(facets, usualReach_), long_})
    std::ranges::copy_if(candidates, std::back_inserter(rows), [&](Index i) {
      return losesSight(X_[i], n.neighboursOf(i), X_, boxes, barrier);
    });
  sortUnique(rows);
  return rows;
}

// Ball by ball, as what is nearest among what is not in a ball lies in the next.
template <class Distance>
std::vector<VisibilitySearch::Seen> VisibilitySearch::nearestSeen(const Wanted& wanted,
                                                                  const CutBarrier& barrier,
                                                                  Distance&& distance) const {
  std::vector<Seen> seen, ring;
  std::vector<std::pair<Index, double>> found;
  std::vector<Vec3> ends;
  std::vector<char> blocked;
  double inner = -1;
  for (const double factor : searchRadii) {
    const double outer = factor * wanted.radius;
    tree_.within(wanted.centre, outer * wanted.extent, found);
    ring.clear();
    for (const auto& [id, squared] : found) {
      const double d = distance(id);
      if (d >= inner && d < outer) ring.push_back({d, id});
    }
    std::sort(ring.begin(), ring.end());
    ends.clear();
    for (const Seen& s : ring) ends.push_back(X_[s.id]);
    blocked.assign(ends.size(), 0);
    const bool all = wanted.wholeBall && inner < 0;
    // no more than needed: most of a large ball is not
    for (std::size_t first = 0; first < ring.size() && (all || seen.size() < wanted.count);) {
      const std::size_t count =
          all ? ring.size() : std::min(ring.size() - first, wanted.count - seen.size());
      barrier.block(wanted.eye, std::span(ends).subspan(first, count),
                    std::span(blocked).subspan(first, count));
      for (const std::size_t end = first + count; first < end; ++first)
        if (!blocked[first]) seen.push_back(ring[first]);
    }
    if (seen.size() >= wanted.count) break;
    inner = outer;
  }
  return seen;
}

void VisibilitySearch::relink(Neighbourhoods& n, Index i, Index fewest, const CutBarrier& barrier) {
  const auto wanted = static_cast<std::size_t>(fewest);
  const bool byRadius = n.options.count == 0;
  const double radius = byRadius ? n.options.radius : radius_[i];
  const auto others = [&](Index j) {
    return j == i ? std::numeric_limits<double>::infinity() : n.distance(i, X_[j] - X_[i]);
  };
  std::vector<Seen> seen =
      nearestSeen({X_[i], X_[i], radius, metricExtent(n, i), wanted, byRadius}, barrier, others);
  // by radius everything within it stays
  std::size_t keep = byRadius ? static_cast<std::size_t>(std::ranges::count_if(
                                    seen, [&](const Seen& s) { return s.distance < radius; }))
                              : 0;
  keep = std::max(keep, std::min(wanted, seen.size()));
  seen.resize(keep);
  const double last = seen.empty() ? 0 : seen.back().distance;
  n.radii[i] = byRadius && last < radius ? radius : n.options.reach * last;

  std::vector<Index> ids;
  std::vector<double> weights;
  for (const Seen& s : seen) {
    ids.push_back(s.id);
    weights.push_back(n.radii[i] > 0 ? kernelWeight(n.options.kernel, s.distance / n.radii[i]) : 0);
  }
  n.assignRow(i, ids, weights);
  const bool wasLong = reach_[i] > usualReach_;
  reach_[i] = reachOf(X_, n, i);
  if (!wasLong && reach_[i] > usualReach_) long_.push_back(i);
}

std::vector<Carrier> VisibilitySearch::carriersOf(const Vec3& point, const Vec3& eye,
                                                  Index supports, const Neighbourhoods& n,
                                                  std::span<const std::uint8_t> rank,
                                                  const CutBarrier& barrier) const {
  const Index closest = nearest(point).particle;
  const auto wanted = static_cast<std::size_t>(supports);
  std::vector<Seen> seen;
  for (const bool whole : {true, false}) {
    const auto usable = [&](Index j) {
      if (whole && rank[j] < 3) return std::numeric_limits<double>::infinity();
      return carryingDistance(n, j, point - X_[j]);
    };
    seen = nearestSeen({point, eye, radius_[closest], metricExtent(n, closest), wanted, false},
                       barrier, usable);
    if (!seen.empty()) break;
  }
  std::vector<Carrier> carriers;
  for (std::size_t k = 0; k < std::min(wanted, seen.size()); ++k)
    carriers.push_back({seen[k].id, seen[k].distance * seen[k].distance});
  return carriers;
}

std::vector<Carrier> VisibilitySearch::sorted(const Vec3& point, std::span<const Index> which,
                                              ConstVec3Span X, const Neighbourhoods& n) {
  std::vector<Seen> all;
  for (const Index i : which) all.push_back({carryingDistance(n, i, point - X[i]), i});
  std::sort(all.begin(), all.end());
  std::vector<Carrier> carriers;
  for (const Seen& s : all) carriers.push_back({s.id, s.distance * s.distance});
  return carriers;
}

Carrier VisibilitySearch::nearest(const Vec3& point) const {
  Carrier found{-1, 0};
  tree_.nearest(point, {&found.particle, 1}, {&found.squared, 1});
  return found;
}

}  // namespace stroma
