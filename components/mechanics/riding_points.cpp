// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/riding_points.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/sorted_ids.h"

namespace stroma {
namespace {

bool seesAll(const Vec3& eye, std::span<const Index> carriers, ConstVec3Span X,
             const CutBarrier& barrier) {
  std::vector<Vec3> ends;
  for (const Index i : carriers) ends.push_back(X[i]);
  std::vector<char> blocked(ends.size(), 0);
  barrier.block(eye, ends, blocked);
  return std::ranges::find(blocked, 1) == blocked.end();
}

// Whether a search would find again what carries a point, given that its eye stays: cuts hide more
// and more, so what was nearest is so as long as it can be seen.
bool keepsCarriers(const RidingPoints& points, Index s, const TopologyChange& change,
                   const CutParticles& particles) {
  const auto carriers = points.shape.carriersOf(s);
  return points.single[s] && points.states[s] == RidingPoints::State::sound &&
         std::ranges::all_of(carriers, [&](Index i) { return particles.gradients.rank[i] == 3; }) &&
         !losesSight(points.eyes[s], carriers, particles.rest, particles.newFacets, change.barrier);
}

}  // namespace

void prepareForCuts(RidingPoints& points, ConstVec3Span rest, ConstVec3Span X) {
  points.eyes.assign(rest.begin(), rest.end());
  points.states.assign(rest.size(), RidingPoints::State::sound);
  points.single.assign(rest.size(), 0);
  points.longestArm = 0;
  points.leastAtRest = fewestLinks;
  for (Index s = 0; s < points.shape.pointCount(); ++s) {
    const auto carriers = points.shape.carriersOf(s);
    points.leastAtRest = std::min(points.leastAtRest, static_cast<Index>(carriers.size()));
    for (const Index i : carriers)
      points.longestArm = std::max(points.longestArm, (X[i] - rest[s]).norm());
  }
  points.shape.reserveForCuts();
}

std::vector<Index> concernedPoints(RidingPoints& points, ConstVec3Span rest, bool cut,
                                   const TopologyChange& change, const CutParticles& particles) {
  std::vector<Index> out;
  const SurfaceEdit& edit = change.edit;
  if (cut) {
    for (auto s = static_cast<Index>(points.eyes.size()); s < static_cast<Index>(rest.size()); ++s)
      out.push_back(s);
    points.eyes.insert(points.eyes.end(), rest.begin() + points.shape.pointCount(), rest.end());
    points.states.resize(rest.size(), RidingPoints::State::sound);
    points.single.resize(rest.size(), 0);
    for (const TouchedNode& touched : edit.touched) {
      points.eyes[touched.node] = touched.inward;
      out.push_back(touched.node);
    }
    for (const Index node : edit.retired) points.states[node] = RidingPoints::State::retired;
  }
  points.keeps.assign(rest.size(), 0);
  points.marks.clear(rest.size());
  for (const Index s : out) static_cast<void>(points.marks.mark(s));
  // carried by a row that has changed
  for (const Index i : particles.relinked)
    for (const PointEntry& e : points.shape.pointsOn(i))
      if (std::ranges::binary_search(points.shape.carriersOf(e.point), i) &&
          points.marks.mark(e.point)) {
        out.push_back(e.point);
        points.keeps[e.point] = keepsCarriers(points, e.point, change, particles);
      }
  // or by a particle that a new facet hides
  if (!edit.cutFacets.empty())
    for (const Index i : particles.search.around(edit.cutFacets, points.longestArm))
      for (const PointEntry& e : points.shape.pointsOn(i))
        if (points.marks.mark(e.point) &&
            losesSight(points.eyes[e.point], points.shape.carriersOf(e.point), particles.rest,
                       particles.newFacets, change.barrier))
          out.push_back(e.point);
  sortUnique(out);
  return out;
}

void carryAnew(RidingPoints& points, ConstVec3Span rest, std::span<const Index> which,
               const CutBarrier& barrier, const CutParticles& particles) {
  points.newChips = 0;
  struct Found {
    PointRow row;
    double arm = 0;
    bool chip = false;
  };
  std::vector<Found> found(which.size());
  constexpr Index chunk = 8;
  parallelChunks(static_cast<Index>(which.size()), chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index s = which[k];
      std::vector<Carrier> carriers =
          points.keeps[s] ? VisibilitySearch::sorted(rest[s], points.shape.carriersOf(s),
                                                     particles.rest, particles.neighbourhoods)
                          : particles.search.carriersOf(rest[s], points.eyes[s], points.supports,
                                                        particles.neighbourhoods,
                                                        particles.gradients.rank, barrier);
      found[k].chip = static_cast<Index>(carriers.size()) < points.fewest();
      if (carriers.empty()) carriers.push_back(particles.search.nearest(rest[s]));
      for (const Carrier& c : carriers)
        found[k].arm = std::max(found[k].arm, (particles.rest[c.particle] - rest[s]).norm());
      found[k].row = SurfaceShape::rowOf(rest[s], carriers, particles.rest,
                                         particles.neighbourhoods, particles.gradients);
    }
  });
  for (std::size_t k = 0; k < which.size(); ++k) {
    points.shape.replaceRow(which[k], found[k].row);
    points.single[which[k]] = 1;
    points.longestArm = std::max(points.longestArm, found[k].arm);
    RidingPoints::State& state = points.states[which[k]];
    if (state == RidingPoints::State::retired) continue;
    points.newChips += found[k].chip && state != RidingPoints::State::chip;
    state = found[k].chip ? RidingPoints::State::chip : RidingPoints::State::sound;
  }
}

void checkPoints(const RidingPoints& points, ConstVec3Span rest, const CutParticles& particles,
                 const std::string& name, TopologyCheck& check) {
  Failures failures(check.failures, name);
  if (points.shape.pointCount() != static_cast<Index>(rest.size())) {
    failures.add("are carried, not all", points.shape.pointCount());
    return;
  }
  for (Index s = 0; s < points.shape.pointCount(); ++s) {
    if (points.states[s] == RidingPoints::State::retired) continue;
    const bool chip = points.states[s] == RidingPoints::State::chip;
    check.freeChips += chip;
    const auto carriers = points.shape.carriersOf(s);
    if (!chip && static_cast<Index>(carriers.size()) < points.fewest())
      failures.add("has too few supports and is not counted as a free chip", s);
    if (!chip && !seesAll(points.eyes[s], carriers, particles.rest, check.barrier))
      failures.add("is carried by a particle behind a cut", s);
    double sum = 0;
    Vec3 at = Vec3::Zero();
    for (const ShapeEntry& e : points.shape.shapeOf(s)) {
      sum += e.weight;
      at += e.weight * (particles.rest[e.particle] - rest[s]);
    }
    if (!(std::abs(sum - 1) < 1e-12)) failures.add("has shape functions that do not sum to 1", s);
    const bool whole =
        std::ranges::all_of(carriers, [&](Index i) { return particles.gradients.rank[i] == 3; });
    if (whole && !(at.norm() < 1e-10 * points.longestArm))
      failures.add("does not lie where its shape functions put it", s);
  }
}

}  // namespace stroma
