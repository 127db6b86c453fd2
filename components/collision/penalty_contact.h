// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/collision/contact_point.h"
#include "components/collision/sample_track.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/tool.h"
#include "core/schedule.h"

namespace stroma {

enum class ContactResponse { penalty, constraint };
template <>
struct EnumNames<ContactResponse> {
  static constexpr std::array<std::pair<ContactResponse, std::string_view>, 2> names{
      {{ContactResponse::penalty, "penalty"}, {ContactResponse::constraint, "constraint"}}};
};

// Contact of tools with a surface, by penalty forces with Coulomb friction. Which points touch, and
// along which normals, is found once a step in Stage::Collide; depths follow the trial states of
// the solver, so that the force is implicit.
//
// A sample of a tool touches at the point of the surface nearest to it; a sphere also at every node
// that it covers. At each such point the surface is pushed by `stiffness` times the depth, plus
// `damping` times the speed of closing, never pulled. Friction acts at the nearest point only: a
// spring of the same stiffness between tool and surface that slips when its force passes
// `friction` times the sample's normal force at the end of the last step. It sticks without creep.
//
// The tool gets the opposite of what the surface gets, at the same points. Its samples touch
// nothing while it cuts.
//
// With response="constraint" each point's force of the last step is added (augmented Lagrangian,
// Hestenes 1969, one update of the multiplier a step): under a resting tool the depth then
// vanishes, whatever the stiffness; under a moving one it is a small part of the tool's way in a
// step.
//
// A solver that makes one linear solve a step (newtonIterations="1") cannot find out in the step
// which points let go. There a point that pressed at the end of the last step is held, as a spring
// to both sides, until it has ended a step without pressing; without that the tissue would leap
// after a tool that draws back and hit it again. Newton's method has the one-sided law itself.
//
// An explicit solver needs a step as short as its sub-steps (substeps="1"): contacts are found once
// a step, and its estimate of stability sees none before it presses. Otherwise a warning says so.
//
// A stiffness some 10 to 30 times that of the tissue under the tool (about 75 N/m at a cornea's
// apex) leaves it 3 to 10 % of the indentation inside; more costs solver iterations.
class PenaltyContactForceField final : public ForceField {
 public:
  Attribute<double> stiffness{
      this,
      "stiffness",
      0.0,
      "Force per depth at each point of contact.",
      {.unit = "N/m", .min = 0, .exclusiveMin = true, .required = true, .runtime = true}};
  Attribute<ContactResponse> response{
      this, "response", ContactResponse::penalty,
      "penalty = force in proportion to the depth; constraint = the depth vanishes under a tool "
      "that rests."};
  Attribute<double> damping{this,
                            "damping",
                            0.0,
                            "Force per speed of closing at each point of contact.",
                            {.unit = "N s/m", .min = 0, .runtime = true}};
  Attribute<double> friction{this,
                             "friction",
                             0.0,
                             "Coefficient of friction between tool and surface.",
                             {.min = 0, .runtime = true, .aliases = "mu"}};
  Attribute<double> margin{
      this,
      "margin",
      0.0,
      "Points of the surface this near to a sample are prepared for contact in "
      "the step; not given = half the mean edge of the surface.",
      {.unit = "m", .min = 0}};
  Attribute<double> maxDepth{this,
                             "maxDepth",
                             0.0,
                             "The force grows no more from 'stiffness' times this on; not given = "
                             "five mean edges of the surface.",
                             {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<double> depth{this,
                          "depth",
                          0.0,
                          "Greatest depth of a sample, at the end of the step.",
                          {.unit = "m", .output = true}};
  Attribute<int> contactCount{this,
                              "contactCount",
                              0,
                              "Points of contact that press, at the end of the step.",
                              {.output = true}};
  Link<BVHCollisionModel> collision{this, "collision", "The surface.", Lookup::nearest};
  LinkList<Tool> tools{
      this, "tools", "What touches it.", Lookup::explicitOnly, {.aliases = "tool"}};

  void bind() override;
  void start() override;
  void reset() override { start(); }
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  // Contacts are found anew in every step, and the numbers of triangles and nodes that are kept in
  // between stay valid when a body is cut; not so when it is whole again.
  void topologyRestored() override { start(); }
  [[nodiscard]] MechanicalState& state() const override { return collision->state(); }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView& at) override;
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double dampingFactor,
                         Vec3Span df) const override;
  // No pattern: which nodes touch changes from step to step.

 private:
  // A point of the surface and the sphere that may press it.
  struct Point {
    Triangle nodes;
    Vec3 weights, normal, centre;
    double radius;
    Vec3 toolVelocity;  // of the tool at the point
    std::size_t tool, track;
    Index sample, triangle;
    Index node;  // where the point is a node, else -1
    bool held;
    double shift;  // added to the depth: the multiplier over the stiffness, 0 for a penalty
    Mat3 stiffness, damping;  // -d force / d position and velocity, when linearised
    [[nodiscard]] Vec3 at(ConstVec3Span a) const { return cornersOf(nodes, a).at(weights); }
    [[nodiscard]] double depth(ConstVec3Span x) const {
      return radius + normal.dot(at(x) - centre);
    }
  };
  // Friction at a sample's nearest point.
  struct Rub {
    std::size_t point;
    Vec3 start;  // the point at the beginning of the step
    Vec3 moved;  // what the tool moves there in the step, with the spring's stretch before it
    double limit;
  };
  // What is kept of a sample between steps.
  struct Track {
    SampleTrack side;
    Vec3 stretch = Vec3::Zero();  // of the friction spring
    double pressed = 0;           // normal force at the end of the last step
  };

  void warnOfEstimate();
  void findContacts(const StepContext& step);
  void touchTool(std::size_t tool, std::uint64_t step);
  void touchSample(std::size_t tool, Index sample);
  void addCoveredNodes(std::size_t tool, Index sample, const Vec3& centre, Index except);
  void addPoint(std::size_t tool, Index sample, const Triangle& nodes, const Vec3& weights,
                const Vec3& normal, Index triangle, Index node);
  void publish(const StepContext& step);
  [[nodiscard]] Track& trackOf(std::size_t tool, Index sample) {
    return tracks_[firstTrack_[tool] + static_cast<std::size_t>(sample)];
  }
  [[nodiscard]] PenaltyLaw penalty(const Point& point) const {
    return {stiffness, maxDepth_, point.held};
  }
  // Depth that the force is in proportion to.
  [[nodiscard]] static double pressedDepth(const Point& point, ConstVec3Span x) {
    return point.depth(x) + point.shift;
  }
  // Force on the surface along minus the normal.
  [[nodiscard]] double pressure(const Point& point, const StateView& at) const;
  [[nodiscard]] Vec3 stretchOf(const Rub& rub, ConstVec3Span x) const;
  [[nodiscard]] Vec3 slip(const Rub& rub, ConstVec3Span x);
  void addContact(const Point& point, const Vec3& rubbed, const StateView& at);

  std::vector<std::size_t> firstTrack_;  // of each tool
  std::vector<Track> tracks_;
  std::vector<Point> points_;  // of this step
  std::vector<Rub> rubs_;
  struct Pressed {
    Index track, node;
    double force;  // N
  };
  std::vector<Pressed> pressed_;   // points that pressed at the end of the last step
  std::vector<Contact> contacts_;  // scratch of the rest
  std::vector<Vec3> rubbed_;       // friction at each point, on the surface
  std::vector<Index> nodes_;
  double margin_ = 0, maxDepth_ = 0;
  bool solvesOnce_ = false;
  Limiter capped_{this, "depthCapped",
                  "Points of contact deeper than 'maxDepth', where the force grew no more."};
};

}  // namespace stroma
