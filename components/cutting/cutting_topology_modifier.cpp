// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutting_topology_modifier.h"

#include <algorithm>
#include <stdexcept>

#include "components/cutting/cut_invariants.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
void CuttingTopologyModifier::configure() {
  const auto require = [&](PierceCriterion criterion, const Attribute<double>& limit) {
    if (pierceCriterion == criterion && !limit.isSet()) {
      error(limit, "attr-required",
            "is needed for pierceCriterion=\"" +
                ValueTraits<PierceCriterion>::print(pierceCriterion) + "\"");
    } else if (pierceCriterion != criterion && limit.isSet()) {
      error(limit, "attr-unused",
            "has no meaning for pierceCriterion=\"" +
                ValueTraits<PierceCriterion>::print(pierceCriterion) + "\"");
    }
  };
  require(PierceCriterion::stress, pierceStress);
  require(PierceCriterion::force, pierceForce);
  require(PierceCriterion::energy, pierceEnergy);
}

void CuttingTopologyModifier::bind() {
  if (pierceCriterion == PierceCriterion::stress && !forceField) {
    error("pierce-stress", "has no force field whose stress could pierce the surface",
          "give forceField=\"@...\"");
  }
  for (Tool* tool : tools.targets()) {
    if (tool->edge().size() < 2)
      error(tools, "tool-blunt", "'" + tool->path() + "' has no edge: it cannot cut");
  }
  if (topology->triangles().empty()) {
    error(topology, "triangles-empty", "'" + topology->path() + "' has no triangles to cut");
  }
  if (!topology->followsCuts()) {
    error(topology, "cut-surface", "'" + topology->path() + "' cannot be cut",
          "a MeshTopology can: give it the triangles");
  }
  if (surfaceState->size() != static_cast<Index>(topology->positions().size())) {
    error(surfaceState, "cut-surface",
          "'" + surfaceState->path() + "' has " + std::to_string(surfaceState->size()) +
              " nodes, '" + topology->path() + "' has " +
              std::to_string(topology->positions().size()));
  }
  if (!failed()) buildComplex();
}

void CuttingTopologyModifier::buildComplex() {
  const ConstVec3Span rest = surfaceState->rest();
  try {
    if (solid) {
      if (solid->tetrahedra().empty()) {
        error(solid, "solid-tetrahedra", "'" + solid->path() + "' has no tetrahedra");
        return;
      }
      std::vector<Vec3> points(solid->positions().begin(), solid->positions().end());
      if (points.size() < rest.size()) throw std::invalid_argument("it has fewer points");
      for (std::size_t k = 0; k < rest.size(); ++k) {
        constexpr double nearly = 1e-9;
        if ((points[k] - rest[k]).norm() > nearly * (1 + rest[k].norm()))
          throw std::invalid_argument("point " + std::to_string(k) + " lies elsewhere");
        points[k] = rest[k];
      }
      complex_ = std::make_unique<SimplicialComplex>(
          SimplicialComplex::fromTetrahedra(points, solid->tetrahedra(), topology->triangles()));
    } else {
      complex_ = std::make_unique<SimplicialComplex>(
          SimplicialComplex::fromTriangles(rest, topology->triangles()));
    }
  } catch (const std::invalid_argument& e) {
    if (solid) {
      error(solid, "cut-solid",
            "'" + solid->path() + "' does not fill '" + topology->path() + "': " + e.what(),
            "the solid's first points must be the surface's, its outside the surface's triangles");
    } else {
      error(topology, "cut-surface", "'" + topology->path() + "' cannot be cut: " + e.what());
    }
    return;
  }
  meanEdge_ = complex_->meanEdgeLength();
  trace_ = IncisionTrace(meanEdge_);
  volume_ = 0;
  if (solid)
    for (Index t = 0; t < complex_->simplexCount(); ++t) volume_ += complex_->volume(t);
  CutterOptions options;
  options.subdivide = subdivide;
  cutter_ = std::make_unique<Cutter>(*complex_, 0, options);
}

void CuttingTopologyModifier::start() {
  const auto modifiers = collect<TopologyModifier>(scene().root());
  for (const TopologyModifier* other : modifiers) {
    if (other == this) break;
    if (&other->surface() != &surface() && &other->particles() != &particles()) continue;
    error("cut-twice", "cuts what '" + other->path() + "' cuts", "name all blades in one");
    return;
  }
  for (std::size_t k = 0; k < tools.targets().size(); ++k) {
    const Tool* tool = tools.targets()[k];
    bool taken = std::ranges::find(tools.targets().begin() + static_cast<std::ptrdiff_t>(k) + 1,
                                   tools.targets().end(), tool) != tools.targets().end();
    for (const auto* other : collect<CuttingTopologyModifier>(scene().root())) {
      if (other == this) break;
      taken =
          taken || std::ranges::find(other->tools.targets(), tool) != other->tools.targets().end();
    }
    if (taken) error(tools, "cut-tool-twice", "'" + tool->path() + "' cuts already: name it once");
  }
  const System* system = scene().systemOf(*mechanicalState);
  if (!system || system->offsetOf(*mechanicalState) < 0) {
    error(mechanicalState, "cut-particles",
          "'" + mechanicalState->path() + "' follows another state: name the particles themselves");
  }
  system = scene().systemOf(*surfaceState);
  if (!system || system->offsetOf(*surfaceState) >= 0) {
    error(surfaceState, "cut-nodes",
          "'" + surfaceState->path() + "' follows no particles: a surface that is cut is mapped");
  }
  const ConstVec3Span rest = mechanicalState->rest();
  if (!failed() && !(RestPlacement::reachOf(rest) > 0 && meanEdge_ > 0)) {
    error("cut-size", "cannot be cut: its particles or the points of its surface coincide");
  }
  if (failed()) return;
  placement_ = std::make_unique<RestPlacement>(rest, RestPlacement::reachOf(rest));
  std::vector<RestTriangle> outer;
  for (const Triangle& t : topology->triangles()) {
    RestTriangle corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = surfaceState->rest()[static_cast<std::size_t>(t[k])];
    outer.push_back(corners);
  }
  course_ = std::make_unique<BladeCourse>(std::move(outer), complex_->dimension() == 3);
  facets_ = std::make_unique<CutFacets>(placement_->reach());
  reset();
}

void CuttingTopologyModifier::reset() {
  // a blade may have set in without having cut anything yet
  if (!history_.empty() || cutter_->cutting()) topologyRestored();
  clear();
}

void CuttingTopologyModifier::clear() {
  for (Tool* tool : tools.targets()) tool->setCutting(false);
  tracks_.assign(tools.targets().size(), Track(bladePoints));
  active_ = -1;
  blade_ = {};
  held_.clear();
  wayOut_ = 0;
  failures_ = 0;
  cutting.set(false);
  changes.set(0);
  addedEnergy.set(0);
  engagedLength.set(0);
  tipStress.set(0);
  Index count = 1;
  static_cast<void>(complex_->pieces(count));
  pieces.set(count);
}

void CuttingTopologyModifier::topologyRestored() {
  buildComplex();
  facets_ = std::make_unique<CutFacets>(placement_->reach());
  history_.clear();
}

void CuttingTopologyModifier::schedule(Schedule& schedule) {
  schedule.add<&CuttingTopologyModifier::cut>(Stage::Topology, *this, "cut along the blades");
}

bool CuttingTopologyModifier::pierces(const Tool& tool, const Track& track) {
  if (needsTrigger && !tool.active()) return false;
  const Pressing& pressing = track.pressing;
  switch (pierceCriterion) {
    case PierceCriterion::none:
      return false;  // no pressing needed
    case PierceCriterion::force:
      return pressing.force() >= pierceForce && pressing.touches();
    case PierceCriterion::energy:
      return pressing.energyPerArea() >= pierceEnergy && pressing.touches();
    case PierceCriterion::stress:
      break;
  }
  if (!pressing.touches()) return false;
  const StateView now = mechanicalState->view(scene().time());
  const Vec3 guess = track.edge.empty() ? pressing.point() : track.edge.back();
  const auto place = placement_->find(pressing.point(), guess, now.x);
  if (!place) return false;
  tipStress.set(vonMisesNear(*forceField, now, placement_->around(place->rest)));
  return tipStress >= pierceStress;
}

void CuttingTopologyModifier::cut(const StepContext&) {
  blade_ = {};
  engagedLength.set(0);
  tipStress.set(0);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Tool& tool = *tools.targets()[t];
    Track& track = tracks_[t];
    const bool active = active_ == static_cast<Index>(t);
    const bool near = track.follow(tool, *mechanicalState, *placement_);
    const BladeCourse::Course course = near ? course_->of(track.edge) : BladeCourse::Course{};
    if (near && wasSet(tool, track)) {
      track.before.clear();
      if (active) {
        leave(false);
        continue;
      }
    }
    if (active) {
      // pierced, the tissue may take some steps to close round the blade; and what goes out goes on
      // for a little, so that no bridge is left there
      constexpr double farOut = 0.5;  // edges
      if (course.engaged()) {
        wayOut_ = 0;
      } else if (near && track.before.size() == track.edge.size()) {
        double moved = 0;
        for (std::size_t k = 0; k < track.edge.size(); ++k)
          moved = std::max(moved, (track.edge[k] - track.before[k]).norm());
        wayOut_ += moved;
      }
      const bool goesOn =
          near && (course.engaged() || !cutter_->cutting() || wayOut_ < farOut * meanEdge_) &&
          (!needsTrigger || tool.active());
      if (!near && cutter_->cutting()) ++lost_;
      if (goesOn)
        advance(tool, track, course);
      else
        leave(true);
      continue;
    }
    track.pressing.add(tool);
    const bool atOnce = pierceCriterion == PierceCriterion::none && course.engaged() &&
                        (!needsTrigger || tool.active());
    if (!atOnce && !pierces(tool, track)) continue;
    if (active_ >= 0) {
      ++busy_;
      continue;
    }
    active_ = static_cast<Index>(t);
    wayOut_ = 0;
    track.pressing.forget();
    tool.setCutting(true);
    cutting.set(true);
    trace_.begin();
    if (!course.engaged()) continue;
    advance(tool, track, course);
  }
}

void CuttingTopologyModifier::advance(Tool& tool, const Track& track,
                                      const BladeCourse::Course& course) {
  if (!course.engaged()) {
    if (cutter_->cutting() && goesForward(tool))
      sweep(BladeCourse::partNear(track.edge, lastCourse_, meanEdge_), lastCourse_.length);
    return;
  }
  showBlade(tool, track, course);
  engagedLength.set(course.inside);
  // far from the body the edge at rest is a guess, and must not cut what else lies there
  std::vector<Vec3> part = BladeCourse::partNear(track.edge, course, meanEdge_);
  blade_.advances = goesForward(tool) && (cutter_->cutting() || !inOldSlit());
  if (!blade_.advances) {
    if (cutter_->cutting() && cutter_->sheet()->distanceToFront(part) > meanEdge_) endCut({});
    return;
  }
  trace_.add(tool, track.edge, course);
  // from where the edge was just before, so that no bridge is left where it came in
  if (!cutter_->cutting() && !track.before.empty() && course_->of(track.before).inside == 0) {
    const std::vector<Vec3> before = BladeCourse::partNear(track.before, course, meanEdge_);
    if (before.size() > 1) {
      static_cast<void>(cutter_->advance(before, course.length));
      record(false, before, course.length);
    }
  }
  lastCourse_ = course;
  sweep(std::move(part), course.length);
}

void CuttingTopologyModifier::sweep(std::vector<Vec3> part, double length) {
  if (part.size() < 2) return;  // the edge has shrunk at rest, and ends before the body
  const Index poses = cutter_->poseCount();
  const SurfaceEdit edit = cutter_->advance(part, length);
  if (cutter_->poseCount() != poses) {
    recordHeld();
    record(false, part, length);
  } else {
    held_ = std::move(part);
  }
  apply(edit);
}

bool CuttingTopologyModifier::goesForward(const Tool& tool) const {
  const Vec3 way = tool.cuttingDirection();
  if (way.isZero()) return true;
  const Vec3 moved = tool.pose() * Vec3::Zero() - tool.previousPose() * Vec3::Zero();
  return moved.dot(tool.pose().orientation * way) > 0;
}

bool CuttingTopologyModifier::inOldSlit() const {
  constexpr double width = 0.15;  // of an edge, to each side
  return std::ranges::all_of(blade_.pieces, [&](const BladePiece& piece) {
    return facets_->near(piece.rest, width * meanEdge_);
  });
}

void CuttingTopologyModifier::endCut(ConstVec3Span edge) {
  const SurfaceEdit edit = cutter_->finish(edge);
  recordHeld();
  record(true, edge, 0);
  apply(edit);
  Index count = 1;
  static_cast<void>(complex_->pieces(count));
  pieces.set(count);
}

void CuttingTopologyModifier::showBlade(Tool& tool, const Track& track,
                                        const BladeCourse::Course& course) {
  const std::vector<Vec3> local = track.points(tool);
  blade_.tool = &tool;
  blade_.pieces.clear();
  // what is inside lies between two places along the edge: of several lobes the gaps count as well
  const double from = course.beginsInside ? 0 : course.firstAt;
  const double to = course.endsInside ? course.length : course.lastAt;
  double along = 0;
  for (std::size_t k = 0; k + 1 < local.size(); ++k) {
    const Vec3 &p = track.edge[k], &q = track.edge[k + 1];
    const double length = (q - p).norm();
    const double first = std::max(from - along, 0.0), last = std::min(to - along, length);
    along += length;
    if (!(last > first)) continue;
    const double middle = 0.5 * (first + last) / length;
    const Vec3 at = local[k] + middle * (local[k + 1] - local[k]);
    const Quat& turn = tool.pose().orientation;
    blade_.pieces.push_back({last - first, p + middle * (q - p), tool.pose() * at,
                             turn * (local[k + 1] - local[k]).normalized()});
  }
}

// A tool that was set to a new place, not moved there, cuts nothing on the way.
bool CuttingTopologyModifier::wasSet(const Tool& tool, const Track& track) const {
  if (track.before.size() != track.edge.size()) return false;
  const std::vector<Vec3> local = track.points(tool);
  double atRest = 0, inScene = 0;
  for (std::size_t k = 0; k < local.size(); ++k) {
    atRest = std::max(atRest, (track.edge[k] - track.before[k]).norm());
    inScene = std::max(inScene, (tool.pose() * local[k] - tool.previousPose() * local[k]).norm());
  }
  constexpr double tissue = 4;  // which moves too
  return atRest > meanEdge_ + tissue * inScene;
}

void CuttingTopologyModifier::leave(bool moved) {
  Tool& tool = *tools.targets()[static_cast<std::size_t>(active_)];
  const std::vector<Vec3>& edge = tracks_[static_cast<std::size_t>(active_)].edge;
  if (cutter_->cutting()) {
    endCut(!moved || edge.empty() || !goesForward(tool)
               ? std::vector<Vec3>()
               : BladeCourse::partNear(edge, lastCourse_, meanEdge_));
  }
  tool.setCutting(false);
  cutting.set(false);
  active_ = -1;
}

void CuttingTopologyModifier::change(const SurfaceEdit& edit) {
  facets_->add(edit.cutFacets);
  scene().changeTopology({*mechanicalState, *surfaceState, *topology, edit, *facets_});
}

void CuttingTopologyModifier::apply(const SurfaceEdit& edit) {
  if (edit.empty()) return;
  changes.set(changes + 1);
  if (checkEvery == 0 || changes % checkEvery != 0) return change(edit);
  System& system = *scene().systemOf(*mechanicalState);
  const auto energy = [&] {
    return system.potentialEnergy({system.x(), system.v(), scene().time()});
  };
  const double before = energy();
  change(edit);
  addedEnergy.set(addedEnergy + energy() - before);
  failures_ += static_cast<int>(check().failures.size());
}

TopologyCheck CuttingTopologyModifier::check() const {
  TopologyCheck report{*mechanicalState, *surfaceState, *topology, *facets_, 0, {}};
  report.failures = checkInvariants(*complex_, volume_).failures;
  if (!std::ranges::equal(topology->triangles(), complex_->surface()))
    report.failures.push_back("'" + topology->path() + "' has other triangles than were cut");
  if (surfaceState->size() != complex_->nodeCount())
    report.failures.push_back("'" + surfaceState->path() + "' has other nodes than were cut");
  scene().checkTopology(report);
  return report;
}

std::vector<std::pair<std::string, double>> CuttingTopologyModifier::lastValues() const {
  if (!course_) return {};
  Index count = 1;
  static_cast<void>(complex_->pieces(count));
  const TopologyCheck report = check();
  const SurfaceNumbers numbers = checkInvariants(*complex_, volume_);
  const IncisionTrace::Measure incision = trace_.measure(*complex_);
  return {{"pieces", count},
          {"incision_length", incision.length},
          {"path_length", incision.path},
          {"incision_turning", incision.turning},
          {"incision_deviation", incision.deviation},
          {"invariant_failures", failures_ + static_cast<double>(report.failures.size())},
          {"free_chips", report.freeChips},
          {"smallest_angle", numbers.smallestAngle},
          {"sliver_fraction", numbers.sliverFraction}};
}

// A pose as 1, number of points, length of the edge, points; the end of a cut with 0 in front.
void CuttingTopologyModifier::record(bool finish, ConstVec3Span edge, double length) {
  history_.insert(history_.end(), {finish ? 0.0 : 1.0, static_cast<double>(edge.size()), length});
  for (const Vec3& p : edge) history_.insert(history_.end(), {p.x(), p.y(), p.z()});
}

// A pose that made no difference yet may do so by what comes next.
void CuttingTopologyModifier::recordHeld() {
  if (!held_.empty()) record(false, held_, lastCourse_.length);
  held_.clear();
}

void CuttingTopologyModifier::replay(StateReader& reader) {
  if (!history_.empty() || cutter_->cutting()) topologyRestored();
  std::vector<double> poses(reader.count<double>("history"));
  if (!reader.read("history", std::span(poses))) return;
  std::vector<Vec3> edge;
  for (std::size_t k = 0; k + 2 < poses.size();) {
    const bool finish = poses[k] == 0;
    const auto points = static_cast<std::size_t>(poses[k + 1]);
    lastCourse_.length = poses[k + 2];
    k += 3;
    if (points > (poses.size() - k) / 3) return;
    edge.clear();
    for (std::size_t p = 0; p < points; ++p, k += 3)
      edge.push_back({poses[k], poses[k + 1], poses[k + 2]});
    const SurfaceEdit edit =
        finish ? cutter_->finish(edge) : cutter_->advance(edge, lastCourse_.length);
    if (!edit.empty()) change(edit);
  }
  history_ = std::move(poses);
}

void CuttingTopologyModifier::save(StateWriter& writer) const {
  writer.write("history", std::span<const double>(history_));
  writer.write("held", ConstVec3Span(held_));
  const std::array<double, 5> last{lastCourse_.length, lastCourse_.firstAt, lastCourse_.lastAt,
                                   lastCourse_.beginsInside ? 1.0 : 0.0,
                                   lastCourse_.endsInside ? 1.0 : 0.0};
  writer.write("lastCourse", std::span<const double>(last));
  writer.write("active", active_);
  writer.write("wayOut", wayOut_);
  writer.write("changes", changes.value());
  writer.write("pieces", pieces.value());
  writer.write("failures", failures_);
  writer.write("addedEnergy", addedEnergy.value());
  trace_.save(writer);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::string name = "tool" + std::to_string(t);
    std::vector<double> numbers(Pressing::numberCount + 1);
    tracks_[t].pressing.save(numbers);
    numbers.back() = tracks_[t].clearance;
    writer.write(name, std::span<const double>(numbers));
    writer.write(name + ".edge", ConstVec3Span(tracks_[t].edge));
  }
}

void CuttingTopologyModifier::restore(StateReader& reader) {
  clear();
  const auto points = [&](const std::string& name) {
    std::vector<Vec3> values(reader.count<double>(name) / 3);
    if (!reader.read(name, Vec3Span(values))) values.clear();
    return values;
  };
  int made = 0, count = 1;
  if (reader.read("changes", made)) changes.set(made);
  if (reader.read("pieces", count)) pieces.set(count);
  static_cast<void>(reader.read("failures", failures_));
  double energy = 0;
  if (reader.read("addedEnergy", energy)) addedEnergy.set(energy);
  static_cast<void>(reader.read("active", active_));
  static_cast<void>(reader.read("wayOut", wayOut_));
  if (active_ >= static_cast<Index>(tracks_.size())) active_ = -1;
  cutting.set(active_ >= 0);
  if (active_ >= 0) tools.targets()[static_cast<std::size_t>(active_)]->setCutting(true);
  std::array<double, 5> last{};
  if (reader.read("lastCourse", std::span<double>(last))) {
    lastCourse_ = {.length = last[0],
                   .inside = 0,
                   .middle = Vec3::Zero(),
                   .first = {},
                   .last = {},
                   .firstAt = last[1],
                   .lastAt = last[2],
                   .beginsInside = last[3] != 0,
                   .endsInside = last[4] != 0};
  }
  held_ = points("held");
  if (!held_.empty()) static_cast<void>(cutter_->advance(held_, lastCourse_.length));
  trace_.restore(reader);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::string name = "tool" + std::to_string(t);
    std::vector<double> numbers(Pressing::numberCount + 1);
    if (!reader.read(name, std::span(numbers))) continue;
    tracks_[t].pressing.restore(numbers);
    tracks_[t].clearance = numbers.back();
    tracks_[t].edge = points(name + ".edge");
    if (tracks_[t].edge.size() < 2) tracks_[t].edge.clear();
  }
}

}  // namespace stroma
