// SPDX-License-Identifier: Apache-2.0
// How point-based elasticity follows cuts.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "components/mechanics/mls_force_field.h"
#include "core/scene.h"
#include "core/sorted_ids.h"
#include "core/traverse.h"
#include "core/triangle.h"

namespace stroma {
namespace {

// The rows and their neighbours, `rings` times over; ascending.
std::vector<Index> ringsAround(const Neighbourhoods& n, std::span<const Index> rows, int rings) {
  std::vector<Index> all(rows.begin(), rows.end()), front = all;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<Index> next;
    for (const Index i : front)
      next.insert(next.end(), n.neighboursOf(i).begin(), n.neighboursOf(i).end());
    sortUnique(next);
    front.clear();
    std::ranges::set_difference(next, all, std::back_inserter(front));
    all.insert(all.end(), front.begin(), front.end());
    std::ranges::sort(all);
  }
  return all;
}

void copyRow(const Row& row, std::span<const Vec3> from, std::span<Vec3> to) {
  for (Index slot = row.begin; slot < row.begin + row.size; ++slot) to[slot] = from[slot];
}

}  // namespace

void MLSForceField::start() {
  cut_.reset();
  const auto modifiers = collect<TopologyModifier>(scene().root());
  const auto own = std::ranges::find_if(
      modifiers, [&](const TopologyModifier* m) { return &m->particles() == &state(); });
  if (own == modifiers.end()) return;
  const TopologyModifier& modifier = **own;
  const ConstVec3Span X = mechanicalState->rest();
  cut_ = std::make_unique<Cut>(modifier, X, neighbourhoods_);
  reserveMore(neighbourhoods_.neighbours);
  reserveMore(neighbourhoods_.weights);
  reserveMore(transposed_.links);
  reserveMore(gradients_.values);
  bonds_->followRows(neighbourhoods_, transposed_, gradients_, {}, {});  // takes the same room
  if (!boundaryShape_) return;
  reserveMore(plainGradients_.values);
  if (!refitted_.empty()) reserveMore(refitted_);
  prepareForCuts(*boundaryShape_, closed_.positions, X);
  const auto triangles = modifier.surface().triangles();
  cut_->followsBoundary = std::ranges::equal(triangles, closed_.triangles) &&
                          std::ranges::equal(modifier.nodes().rest(), closed_.positions);
  if (cut_->followsBoundary) cut_->triangles.assign(triangles.begin(), triangles.end());
}

CutParticles MLSForceField::cutParticles() const {
  return {mechanicalState->rest(), neighbourhoods_, plainGradients(), cut_->search,
          cut_->newFacets,         cut_->relinked};
}

void MLSForceField::topologyChanged(const TopologyChange& change) {
  if (!cut_ || &change.particles != &state()) return;
  ++cut_->changes;
  cut_->newFacets = FacetBoxes(change.edit.cutFacets);
  cut_->relinked = cut_->search.blockedRows(neighbourhoods_, change.edit.cutFacets, cut_->newFacets,
                                            change.barrier);
  std::vector<Index> ends = relinkRows(change.barrier);
  std::vector<Index> rows = cut_->relinked;
  if (cut_->followsBoundary) {
    followBoundary(change);
    rows = projectAround(cut_->relinked);
  }
  for (const Index i : rows)
    ends.insert(ends.end(), neighbourhoods_.neighboursOf(i).begin(),
                neighbourhoods_.neighboursOf(i).end());
  sortUnique(ends);
  const double before = change.energy ? energyOf(rows) : 0;
  bonds_->followRows(neighbourhoods_, transposed_, gradients_, rows, ends);
  if (!change.energy) return;
  change.energy->added += energyOf(rows) - before;
  std::vector<Index>& particles = change.energy->particles;
  particles.insert(particles.end(), rows.begin(), rows.end());
  sortUnique(particles);
}

// Replaces the rows to be relinked. Returns the neighbours that they had.
std::vector<Index> MLSForceField::relinkRows(const CutBarrier& barrier) {
  std::vector<Index> all, before;
  for (const Index i : cut_->relinked) {
    const auto row = neighbourhoods_.neighboursOf(i);
    before.assign(row.begin(), row.end());
    all.insert(all.end(), before.begin(), before.end());
    fitRelinkedRow(i, barrier);
    transposed_.followRow(neighbourhoods_, i, before);
    const bool chip = neighbourhoods_.rows[i].size < cut_->fewest[i];
    if (chip && !cut_->chips[i]) ++freeChips;
    cut_->chips[i] = chip;
  }
  for (Gradients* g : {&gradients_, &plainGradients_})
    std::ranges::sort(g->deficient, {}, &DeficientParticle::particle);
  return all;
}

// A row too thin to be fitted well takes in twice as many, as widening does in an uncut body.
void MLSForceField::fitRelinkedRow(Index i, const CutBarrier& barrier) {
  const ConstVec3Span X = mechanicalState->rest();
  const Index count = neighbourhoods_.options.count;
  Index fewest = count > 0 ? count : fewestLinks;
  for (int attempt = 0; attempt < 2; ++attempt, fewest *= 2) {
    cut_->search.relink(neighbourhoods_, i, fewest, barrier);
    gradients_.values.resize(neighbourhoods_.neighbours.size(), Vec3::Zero());
    if (fitRow(X, neighbourhoods_, i, gradients_) >= soundTau) break;
  }
  if (plainGradients_.values.empty()) return;
  plainGradients_.values.resize(neighbourhoods_.neighbours.size(), Vec3::Zero());
  fitRow(X, neighbourhoods_, i, plainGradients_);
  if (refitted_.empty()) return;
  refitted_.resize(neighbourhoods_.neighbours.size(), Vec3::Zero());
  copyRow(neighbourhoods_.rows[i], plainGradients_.values, refitted_);
}

// The surface's nodes, their areas, and what both add to the boundary term.
void MLSForceField::followBoundary(const TopologyChange& change) {
  const SurfaceEdit& edit = change.edit;
  const ConstVec3Span nodes = change.nodes.rest();
  RidingPoints& points = *boundaryShape_;
  points.change = cut_->changes;
  points.redone = concernedPoints(points, nodes, true, change, cutParticles());

  std::vector<Index> changed = points.redone;
  for (const ChangedTriangle& t : edit.changed) {
    const Triangle& old = cut_->triangles[static_cast<std::size_t>(t.slot)];
    changed.insert(changed.end(), old.begin(), old.end());
    changed.insert(changed.end(), t.nodes.begin(), t.nodes.end());
  }
  for (const AppendedTriangle& t : edit.appended)
    changed.insert(changed.end(), t.nodes.begin(), t.nodes.end());
  sortUnique(changed);

  const auto addBoundary = [&](double sign) {
    for (const Index s : changed) {
      if (s >= points.shape.pointCount()) continue;
      for (const ShapeEntry& e : points.shape.shapeOf(s))
        boundary_[e.particle] += sign * e.weight * areas_[static_cast<std::size_t>(s)];
    }
  };
  const auto addArea = [&](const Triangle& t, double sign) {
    const Vec3 area = sign / 6 * cornersOf(t, nodes).areaNormal();
    for (const Index node : t) areas_[static_cast<std::size_t>(node)] += area;
  };
  addBoundary(-1);
  areas_.resize(nodes.size(), Vec3::Zero());
  for (const ChangedTriangle& t : edit.changed) {
    Triangle& slot = cut_->triangles[static_cast<std::size_t>(t.slot)];
    addArea(slot, -1);
    addArea(slot = t.nodes, 1);
  }
  for (const AppendedTriangle& t : edit.appended) {
    cut_->triangles.push_back(t.nodes);
    addArea(t.nodes, 1);
  }
  carryAnew(points, nodes, points.redone, change.barrier, cutParticles());
  addBoundary(1);
}

// Makes the rows around these consistent again, but for those of chips, which have no freedom left.
// Returns all of them.
std::vector<Index> MLSForceField::projectAround(std::span<const Index> relinked) {
  const std::vector<Index> rows = ringsAround(neighbourhoods_, relinked, 2);
  cut_->projection.reset();
  std::vector<Index> free;
  std::ranges::copy_if(rows, std::back_inserter(free), [&](Index i) { return !cut_->chips[i]; });
  if (free.empty()) return rows;
  // from where the first projection began: corrections of corrections would add up
  const std::vector<Vec3>& from = refitted_.empty() ? plainGradients_.values : refitted_;
  for (const Index i : rows) copyRow(neighbourhoods_.rows[i], from, gradients_.values);
  constexpr int iterationsForExact = 30;
  ProjectionOptions options;
  options.iterations = projectionIterations > 0 ? *projectionIterations : iterationsForExact;
  cut_->projection = makeConsistentLocally(mechanicalState->rest(), neighbourhoods_, transposed_,
                                           volumes_, boundary_, free, gradients_, options);
  plainRows.add(static_cast<std::uint64_t>(cut_->projection->left));
  return rows;
}

void MLSForceField::follow(RidingPoints& points, ConstVec3Span rest, bool cut,
                           const TopologyChange& change) {
  if (points.change == cut_->changes) return;
  points.change = cut_->changes;
  points.redone = concernedPoints(points, rest, cut, change, cutParticles());
  carryAnew(points, rest, points.redone, change.barrier, cutParticles());
}

void MLSForceField::topologyRestored() {
  if (!cut_ || cut_->changes == 0) return;
  plainGradients_ = {};
  static_cast<void>(build());
  start();
}

void MLSForceField::checkRow(Index i, const CutBarrier& barrier, Failures& failures) const {
  const ConstVec3Span X = mechanicalState->rest();
  const Row& row = neighbourhoods_.rows[i];
  const bool chip = cut_->chips[i];
  if (!chip && row.size < cut_->fewest[i])
    failures.add("has too few neighbours and is not counted as a free chip", i);
  std::vector<Vec3> ends;
  for (const Index j : neighbourhoods_.neighboursOf(i)) ends.push_back(X[j]);
  std::vector<char> blocked(ends.size(), 0), back(1, 0);
  barrier.block(X[i], ends, blocked);
  Mat3 sum = Mat3::Zero(), plainSum = Mat3::Zero();
  const Gradients& plain = plainGradients();
  for (Index k = 0; k < row.size; ++k) {
    const Index slot = row.begin + k, j = neighbourhoods_.neighbours[slot];
    if (blocked[k]) failures.add("has a neighbour behind a cut", i);
    barrier.block(ends[k], {&X[i], 1}, back);
    if (back[0] != blocked[k]) failures.add("has a link that is cut one way only", i);
    const auto links = transposed_.linksOf(j);
    const auto link = std::ranges::lower_bound(links, i, {}, &BackLink::particle);
    if (link == links.end() || link->particle != i || link->slot != slot) {
      failures.add("has a neighbour that does not know of it", i);
      continue;
    }
    const Vec3& g = gradients_.values[slot];
    const Bond& own = bonds_->own(i)[k];
    if (own.particle != j || Vec3(own.g[0], own.g[1], own.g[2]) != g)
      failures.add("has forces that do not know its links", i);
    const Bond& other = bonds_->back(j)[link - links.begin()];
    const Vec3 expected = -bonds_->volume(i) * g;
    if (other.particle != i || Vec3(other.g[0], other.g[1], other.g[2]) != expected)
      failures.add("has a neighbour whose forces do not know their link", i);
    sum += (ends[k] - X[i]) * g.transpose();
    plainSum += (ends[k] - X[i]) * plain.values[slot].transpose();
  }
  if (gradients_.rank[i] == 3 &&
      !((sum - Mat3::Identity()).norm() < 1e-9 && (plainSum - Mat3::Identity()).norm() < 1e-9))
    failures.add("does not see linear motions exactly", i);
}

void MLSForceField::checkTopology(TopologyCheck& check) const {
  if (!cut_ || &check.particles != &state()) return;
  Failures failures(check.failures, path() + ": particle");
  std::size_t links = 0, backLinks = 0;
  for (Index i = 0; i < neighbourhoods_.particleCount(); ++i) {
    checkRow(i, check.barrier, failures);
    check.freeChips += cut_->chips[i];
    links += neighbourhoods_.neighboursOf(i).size();
    backLinks += transposed_.linksOf(i).size();
  }
  if (links != backLinks)
    check.failures.push_back(path() + ": " + std::to_string(links) + " links, but " +
                             std::to_string(backLinks) + " ends of links");
}

}  // namespace stroma
