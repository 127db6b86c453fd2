// SPDX-License-Identifier: Apache-2.0
#include "components/collision/penalty_contact.h"

#include <algorithm>

#include "core/interfaces/integrator.h"
#include "core/scene.h"
#include "core/snapshot.h"
#include "core/traverse.h"

namespace stroma {
namespace {

Mat3 projectorAcross(const Vec3& normal) { return Mat3::Identity() - normal * normal.transpose(); }

}  // namespace

void PenaltyContactForceField::bind() {
  for (const PenaltyContactForceField* other : collect<PenaltyContactForceField>(scene().root())) {
    if (other == this) break;
    for (const Tool* tool : tools.targets()) {
      if (std::ranges::find(other->tools.targets(), tool) == other->tools.targets().end()) continue;
      error(tools, "contact-second",
            "'" + tool->path() + "' has its contacts from '" + other->path() + "' already",
            "a tool touches one surface");
    }
  }
  std::size_t count = 0;
  firstTrack_.clear();
  for (const Tool* tool : tools.targets()) {
    firstTrack_.push_back(count);
    count += tool->samplePoints().size();
  }
  tracks_.resize(count);
  margin_ = margin.isSet() ? *margin : 0.5 * collision->meanEdge();
  maxDepth_ = maxDepth.isSet() ? *maxDepth : 5 * collision->meanEdge();
  points_.reserve(4 * count);
  rubs_.reserve(count);
}

void PenaltyContactForceField::start() {
  std::ranges::fill(tracks_, Track{});
  points_.clear();
  rubs_.clear();
  pressed_.clear();
  const System* system = scene().systemOf(state());
  solvesOnce_ = system && system->integrator().solvesOnce();
}

void PenaltyContactForceField::schedule(Schedule& schedule) {
  warnOfEstimate();
  schedule.add<&PenaltyContactForceField::findContacts>(Stage::Collide, *this, "find contacts");
  // after the mapped states have followed, before the devices get their force
  schedule.add<&PenaltyContactForceField::publish>(Stage::Guard, *this, "contacts to the tools");
}

// Where a tool touches is found once a step, and an estimate of stability sees nothing of a
// one-sided force before it acts.
void PenaltyContactForceField::warnOfEstimate() {
  const System* system = scene().systemOf(state());
  if (!system || !system->integrator().hasSubsteps()) return;
  warning("contact-substeps",
          "contact with an explicit solver needs 'substeps' of 1 and a short 'dt': contacts are "
          "found once a step, and the estimate of stability does not see them before they press",
          "give '" + system->integrator().name() +
              "' substeps=\"1\" and the scene the length of a sub-step as 'dt', or use an "
              "implicit solver");
}

void PenaltyContactForceField::findContacts(const StepContext& step) {
  points_.clear();
  rubs_.clear();
  for (std::size_t k = 0; k < tools.targets().size(); ++k) touchTool(k, step.step);
}

void PenaltyContactForceField::touchTool(std::size_t k, std::uint64_t step) {
  const Tool& tool = *tools.targets()[k];
  const auto samples = tool.samplePoints();
  const auto tracks = std::span(tracks_).subspan(firstTrack_[k], samples.size());
  if (tool.cutting()) {
    std::ranges::fill(tracks, Track{});
    return;
  }

  Bounds path;
  bool inside = false;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    path.add(tool.previousPose() * samples[s]);
    path.add(tool.pose() * samples[s]);
    inside = inside || tracks[s].side.inside();
  }
  path.grow(tool.radius() + margin_);
  if (!inside && !path.meets(collision->bounds(step))) {
    for (std::size_t s = 0; s < samples.size(); ++s) {
      tracks[s] = Track{};
      tracks[s].side.setOutside(tool.pose() * samples[s]);
    }
    return;
  }
  collision->follow(step);
  for (std::size_t s = 0; s < samples.size(); ++s) touchSample(k, static_cast<Index>(s));
}

void PenaltyContactForceField::touchSample(std::size_t k, Index sample) {
  const Tool& tool = *tools.targets()[k];
  const Vec3& local = tool.samplePoints()[static_cast<std::size_t>(sample)];
  const Vec3 from = tool.previousPose() * local, to = tool.pose() * local;
  const double radius = tool.radius();
  Track& track = trackOf(k, sample);
  const auto touch = track.side.follow(*collision, from, to, radius, margin_);
  if (!touch) {
    track.stretch = Vec3::Zero();
    track.pressed = 0;
    return;
  }
  const Triangle& nodes = collision->triangles()[static_cast<std::size_t>(touch->triangle)];
  // at a node it is that node's point, whichever the nearest one is in the next step
  Eigen::Index corner = 0;
  const bool atNode = touch->weights.maxCoeff(&corner) == 1;
  const Index node = atNode ? nodes[static_cast<std::size_t>(corner)] : -1;
  addPoint(k, sample, nodes, touch->weights, touch->normal, touch->triangle, node);
  if (friction > 0) {
    // how the tool's own material at the point moves in the step
    const Vec3 inTool = tool.pose().orientation.conjugate() * (touch->point - tool.pose().position);
    const Vec3 moved = touch->point - tool.previousPose() * inTool;
    rubs_.push_back(
        {points_.size() - 1, touch->point, track.stretch + moved, friction * track.pressed});
  }
  if (radius > 0 && !touch->inside) addCoveredNodes(k, sample, to, node);
}

// A node is covered when the sphere's centre is on its front and within reach.
void PenaltyContactForceField::addCoveredNodes(std::size_t k, Index sample, const Vec3& centre,
                                               Index except) {
  const double reach = tools.targets()[k]->radius() + margin_;
  collision->nodesInBall(centre, reach, nodes_);
  for (const Index node : nodes_) {
    const Vec3 away = centre - collision->positions()[static_cast<std::size_t>(node)];
    const double distance = away.norm();
    const bool inFront = distance > 0 && away.dot(collision->outwardAtNode(node)) > 0;
    if (node == except || !inFront) continue;
    addPoint(k, sample, {node, node, node}, Vec3::UnitX(), away / distance,
             collision->triangleAt(node), node);
  }
}

void PenaltyContactForceField::addPoint(std::size_t k, Index sample, const Triangle& nodes,
                                        const Vec3& weights, const Vec3& normal, Index triangle,
                                        Index node) {
  const Tool& tool = *tools.targets()[k];
  const std::size_t track = firstTrack_[k] + static_cast<std::size_t>(sample);
  Point point{};
  point.nodes = nodes;
  point.weights = weights;
  point.normal = normal;
  point.centre = tool.pose() * tool.samplePoints()[static_cast<std::size_t>(sample)];
  point.radius = tool.radius();
  point.tool = k;
  point.track = track;
  point.sample = sample;
  point.triangle = triangle;
  point.node = node;
  const auto last = std::ranges::find_if(pressed_, [&](const Pressed& p) {
    return p.track == static_cast<Index>(track) && p.node == node;
  });
  const bool again = last != pressed_.end();
  point.held = solvesOnce_ && again;
  if (again && *response == ContactResponse::constraint) point.shift = last->force / stiffness;
  const Vec3 arm = point.at(collision->positions()) - tool.pose().position;
  point.toolVelocity = tool.linearVelocity() + tool.angularVelocity().cross(arm);
  points_.push_back(point);
}

double PenaltyContactForceField::pressure(const Point& point, const StateView& at) const {
  const double d = pressedDepth(point, at.x), spring = penalty(point).force(d);
  if (d <= 0 || damping == 0) return spring;
  const double closing = point.normal.dot(point.at(at.v) - point.toolVelocity);
  return std::max(0.0, spring + damping * closing);
}

Vec3 PenaltyContactForceField::stretchOf(const Rub& rub, ConstVec3Span x) const {
  const Point& point = points_[rub.point];
  const Vec3 stretch = rub.moved - (point.at(x) - rub.start);
  return stretch - point.normal.dot(stretch) * point.normal;
}

void PenaltyContactForceField::addForce(const StateView& at, Vec3Span f) {
  const auto spread = [&](const Point& point, const Vec3& force) {
    for (std::size_t c = 0; c < 3; ++c) {
      f[static_cast<std::size_t>(point.nodes[c])] +=
          point.weights[static_cast<Eigen::Index>(c)] * force;
    }
  };
  for (const Point& point : points_) spread(point, -pressure(point, at) * point.normal);
  for (const Rub& rub : rubs_) {
    spread(points_[rub.point], FrictionLaw{stiffness, rub.limit}.force(stretchOf(rub, at.x)));
  }
}

double PenaltyContactForceField::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (const Point& point : points_) energy += penalty(point).energy(pressedDepth(point, at.x));
  for (const Rub& rub : rubs_) {
    energy += FrictionLaw{stiffness, rub.limit}.energy(stretchOf(rub, at.x));
  }
  return energy;
}

void PenaltyContactForceField::linearize(const StateView& at) {
  for (Point& point : points_) {
    const Mat3 along = point.normal * point.normal.transpose();
    const double d = pressedDepth(point, at.x);
    const bool presses = d > 0 && pressure(point, at) > 0;
    point.stiffness = (d <= 0 || presses ? penalty(point).tangent(d) : 0) * along;
    point.damping = (presses ? *damping : 0) * along;
  }
  for (const Rub& rub : rubs_) {
    Point& point = points_[rub.point];
    point.stiffness += FrictionLaw{stiffness, rub.limit}.tangent(stretchOf(rub, at.x),
                                                                 projectorAcross(point.normal));
  }
}

void PenaltyContactForceField::addTangentProduct(ConstVec3Span dx, double stiffnessFactor,
                                                 double dampingFactor, Vec3Span df) const {
  for (const Point& point : points_) {
    const Vec3 change =
        -(stiffnessFactor * point.stiffness + dampingFactor * point.damping) * point.at(dx);
    for (std::size_t c = 0; c < 3; ++c) {
      df[static_cast<std::size_t>(point.nodes[c])] +=
          point.weights[static_cast<Eigen::Index>(c)] * change;
    }
  }
}

void PenaltyContactForceField::publish(const StepContext& step) {
  const StateView at = state().view(step.time);
  for (Track& track : tracks_) track.pressed = 0;
  pressed_.clear();
  for (const Point& point : points_) {
    const double force = pressure(point, at);
    if (!(force > 0)) continue;
    tracks_[point.track].pressed += force;
    pressed_.push_back({static_cast<Index>(point.track), point.node, force});
  }
  rubbed_.assign(points_.size(), Vec3::Zero());
  for (const Rub& rub : rubs_) rubbed_[rub.point] = slip(rub, at.x);
  depth.set(0);
  contactCount.set(0);
  for (std::size_t k = 0; k < tools.targets().size(); ++k) {
    contacts_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].tool == k) addContact(points_[i], rubbed_[i], at);
    }
    tools.targets()[k]->setContacts(contacts_);
  }
}

// The spring's force on the surface; then it gives way to what friction holds now.
Vec3 PenaltyContactForceField::slip(const Rub& rub, ConstVec3Span x) {
  Track& track = tracks_[points_[rub.point].track];
  const Vec3 stretch = stretchOf(rub, x);
  const double longest = friction * track.pressed / stiffness, length = stretch.norm();
  track.stretch = length > longest ? Vec3((longest / length) * stretch) : stretch;
  return FrictionLaw{stiffness, rub.limit}.force(stretch);
}

void PenaltyContactForceField::addContact(const Point& point, const Vec3& rubbed,
                                          const StateView& at) {
  const double pressed = pressure(point, at);
  const Vec3 force = pressed * point.normal - rubbed;
  if (pressedDepth(point, at.x) > maxDepth_) ++capped_;
  if (force.isZero(0)) return;
  const double d = point.depth(at.x);
  if (pressed > 0) contactCount.set(contactCount + 1);
  depth.set(std::max<double>(depth, d));
  contacts_.push_back({point.at(at.x), point.normal, d, stiffness, point.at(at.v), force,
                       point.sample, point.triangle});
}

void PenaltyContactForceField::save(StateWriter& writer) const {
  constexpr std::size_t size = SampleTrack::numberCount + 4;
  std::vector<double> numbers(size * tracks_.size());
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const auto own = std::span(numbers).subspan(size * k, size);
    tracks_[k].side.save(own);
    for (std::size_t c = 0; c < 3; ++c) {
      own[SampleTrack::numberCount + c] = tracks_[k].stretch[static_cast<Eigen::Index>(c)];
    }
    own.back() = tracks_[k].pressed;
  }
  writer.write("tracks", std::span<const double>(numbers));
  writer.write("pressed", std::span<const Pressed>(pressed_));
}

void PenaltyContactForceField::restore(StateReader& reader) {
  constexpr std::size_t size = SampleTrack::numberCount + 4;
  std::vector<double> numbers(size * tracks_.size());
  start();
  if (!reader.read("tracks", std::span<double>(numbers))) return;
  pressed_.resize(reader.count<Pressed>("pressed"));
  if (!reader.read("pressed", std::span<Pressed>(pressed_))) pressed_.clear();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const auto own = std::span<const double>(numbers).subspan(size * k, size);
    tracks_[k].side.restore(own);
    const double* stretch = own.data() + SampleTrack::numberCount;
    tracks_[k].stretch = {stretch[0], stretch[1], stretch[2]};
    tracks_[k].pressed = own.back();
  }
}

}  // namespace stroma
