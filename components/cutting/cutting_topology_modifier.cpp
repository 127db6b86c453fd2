// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutting_topology_modifier.h"

#include <algorithm>
#include <stdexcept>

#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

double largestDistance(ConstVec3Span a, ConstVec3Span b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
  return most;
}

std::vector<Vec3> placed(const Pose& pose, std::vector<Vec3> points) {
  for (Vec3& p : points) p = pose * p;
  return points;
}

}  // namespace

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
  std::vector<const Tool*> taken;
  for (const auto* other : collect<CuttingTopologyModifier>(scene().root())) {
    for (const Tool* tool : other->tools.targets()) {
      if (other == this && std::ranges::find(taken, tool) != taken.end())
        error(tools, "cut-tool-twice", "'" + tool->path() + "' cuts already: name it once");
      taken.push_back(tool);
    }
    if (other == this) break;
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
  wayOut_ = 0;
  failures_ = 0;
  cutting.set(false);
  changes.set(0);
  addedEnergy.set(0);
  takenEnergy.set(0);
  debt_.clear();
  engagedLength.set(0);
  tipStress.set(0);
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
  const double stress = vonMisesNear(*forceField, now, placement_->around(place->rest));
  tipStress.set(std::max<double>(tipStress, stress));
  return stress >= pierceStress;
}

void CuttingTopologyModifier::cut(const StepContext&) {
  blade_ = {};
  engagedLength.set(0);
  tipStress.set(0);
  const Index before = active_;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Tool& tool = *tools.targets()[t];
    Track& track = tracks_[t];
    const bool near = track.follow(tool, *mechanicalState, *placement_);
    const BladeCourse::Course course = near ? course_->of(track.edge) : BladeCourse::Course{};
    const bool set = near && wasSet(tool, track);
    if (set) track.before.clear();
    if (before == static_cast<Index>(t)) {
      if (!near && cutter_->cutting()) ++lost_;
      if (set || !staysIn(track, near, course) || (needsTrigger && !tool.active()))
        leave(!set);
      else
        advance(tool, track, course);
      continue;
    }
    track.pressing.add(tool);
    const bool atOnce = pierceCriterion == PierceCriterion::none && course.engaged() &&
                        (!needsTrigger || tool.active());
    if (!atOnce && !pierces(tool, track)) {
      constexpr double deep = 0.25;  // edges; contacts of this step are not known yet
      const bool unpressed = course.inside > deep * meanEdge_ && !track.pressing.touches();
      if (pierceCriterion != PierceCriterion::none && unpressed) ++untouched_;
      continue;
    }
    if (active_ >= 0 || before >= 0) {  // also one that has left in this step: one change a step
      ++busy_;
      continue;
    }
    active_ = static_cast<Index>(t);
    wayOut_ = 0;
    track.pressing.forget();
    tool.setCutting(true);
    cutting.set(true);
    trace_.begin();
    advance(tool, track, course);
  }
  debt_.pay(*scene().systemOf(*mechanicalState), *mechanicalState);
  takenEnergy.set(debt_.paid());
}

// What goes out goes on for a little, so that no bridge is left there; and a blade that has pierced
// may go a little while the tissue closes round it.
bool CuttingTopologyModifier::staysIn(const Track& track, bool near,
                                      const BladeCourse::Course& course) {
  if (!near) return false;
  if (course.engaged()) {
    wayOut_ = 0;
    return true;
  }
  if (track.before.size() == track.edge.size())
    wayOut_ += largestDistance(track.before, track.edge);
  const double most = cutter_->cutting() ? 0.5 : 1.0;  // edges
  return wayOut_ < most * meanEdge_;
}

void CuttingTopologyModifier::advance(Tool& tool, const Track& track,
                                      const BladeCourse::Course& course) {
  if (!course.engaged()) {
    if (cutter_->cutting() && goesForward(tool))
      sweep(BladeCourse::partNear(track.edge, lastExtent_, meanEdge_), lastExtent_.length);
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
    sweep(BladeCourse::partNear(track.before, course, meanEdge_), course.length);
  }
  lastExtent_ = course;
  sweep(std::move(part), course.length);
}

void CuttingTopologyModifier::sweep(std::vector<Vec3> part, double length) {
  if (!part.empty()) apply(history_.advance(*cutter_, std::move(part), length));
}

// By the mean motion of the edge: it may turn about its tip.
bool CuttingTopologyModifier::goesForward(const Tool& tool) const {
  const Vec3 way = tool.cuttingDirection();
  if (way.isZero()) return true;
  Vec3 moved = Vec3::Zero();
  for (const Vec3& p : tool.edge()) moved += tool.pose() * p - tool.previousPose() * p;
  return moved.dot(tool.pose().orientation * way) > 0;
}

bool CuttingTopologyModifier::inOldSlit() const {
  constexpr double width = 0.15;  // of an edge, to each side
  return std::ranges::all_of(blade_.pieces, [&](const BladePiece& piece) {
    return facets_->near(piece.rest, width * meanEdge_);
  });
}

void CuttingTopologyModifier::endCut(ConstVec3Span edge) { apply(history_.finish(*cutter_, edge)); }

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
  const std::vector<Vec3> points = track.points(tool);
  const double inScene =
      largestDistance(placed(tool.previousPose(), points), placed(tool.pose(), points));
  constexpr double tissue = 4;  // which moves too
  return largestDistance(track.before, track.edge) > meanEdge_ + tissue * inScene;
}

void CuttingTopologyModifier::leave(bool moved) {
  Tool& tool = *tools.targets()[static_cast<std::size_t>(active_)];
  const std::vector<Vec3>& edge = tracks_[static_cast<std::size_t>(active_)].edge;
  if (cutter_->cutting()) {
    endCut(!moved || edge.empty() || !goesForward(tool)
               ? std::vector<Vec3>()
               : BladeCourse::partNear(edge, lastExtent_, meanEdge_));
  }
  tool.setCutting(false);
  cutting.set(false);
  active_ = -1;
}

void CuttingTopologyModifier::change(const SurfaceEdit& edit, LinkEnergy* energy) {
  facets_->add(edit.cutFacets);
  scene().changeTopology({*mechanicalState, *surfaceState, *topology, edit, *facets_, energy});
}

void CuttingTopologyModifier::apply(const SurfaceEdit& edit) {
  if (edit.empty()) return;
  changes.set(changes + 1);
  LinkEnergy energy;
  change(edit, &energy);
  addedEnergy.set(addedEnergy + energy.added);
  if (energy.added > 0) debt_.owe(energy.added, energy.particles);
  if (checkEvery > 0 && changes % checkEvery == 0)
    failures_ += static_cast<int>(check().failures.size());
}

TopologyCheck CuttingTopologyModifier::check() const {
  return check(checkInvariants(*complex_, volume_));
}

TopologyCheck CuttingTopologyModifier::check(const SurfaceNumbers& surface) const {
  TopologyCheck report{*mechanicalState, *surfaceState, *topology, *facets_, 0, {}};
  report.failures = surface.failures;
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
  const SurfaceNumbers numbers = checkInvariants(*complex_, volume_);
  const TopologyCheck report = check(numbers);
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

void CuttingTopologyModifier::replay(StateReader& reader) {
  if (!history_.empty() || cutter_->cutting()) topologyRestored();
  history_.replay(reader, *cutter_, [this](const SurfaceEdit& edit) { change(edit, nullptr); });
}

void CuttingTopologyModifier::save(StateWriter& writer) const {
  history_.save(writer);
  const std::array<double, 5> extent{lastExtent_.length, lastExtent_.firstAt, lastExtent_.lastAt,
                                     lastExtent_.beginsInside ? 1.0 : 0.0,
                                     lastExtent_.endsInside ? 1.0 : 0.0};
  writer.write("extent", std::span<const double>(extent));
  writer.write("active", active_);
  writer.write("wayOut", wayOut_);
  writer.write("changes", changes.value());
  writer.write("failures", failures_);
  writer.write("addedEnergy", addedEnergy.value());
  trace_.save(writer);
  debt_.save(writer);
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
  int made = 0;
  if (reader.read("changes", made)) changes.set(made);
  static_cast<void>(reader.read("failures", failures_));
  double energy = 0;
  if (reader.read("addedEnergy", energy)) addedEnergy.set(energy);
  static_cast<void>(reader.read("active", active_));
  static_cast<void>(reader.read("wayOut", wayOut_));
  if (active_ >= static_cast<Index>(tracks_.size())) active_ = -1;
  cutting.set(active_ >= 0);
  if (active_ >= 0) tools.targets()[static_cast<std::size_t>(active_)]->setCutting(true);
  std::array<double, 5> extent{};
  if (reader.read("extent", std::span<double>(extent)))
    lastExtent_ = {extent[0], extent[1], extent[2], extent[3] != 0, extent[4] != 0};
  trace_.restore(reader);
  debt_.restore(reader);
  takenEnergy.set(debt_.paid());
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
