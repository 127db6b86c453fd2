// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/haptic_device.h"

namespace stroma {

// Where a tool touches a surface, at the end of a step.
struct Contact {
  Vec3 point = Vec3::Zero();     // on the surface (m)
  Vec3 normal = Vec3::UnitZ();   // unit, out of the tissue
  double depth = 0;              // m, positive: the tool is inside
  double stiffness = 0;          // N/m, of the response along the normal
  Vec3 velocity = Vec3::Zero();  // of the tissue at the point (m/s)
  Vec3 force = Vec3::Zero();     // on the tool (N)
  Index sample = 0;              // of the tool
  Index triangle = 0;            // of the surface
};

// A rigid instrument as the simulation sees it. Who moves it is its own affair (a script, a hand
// behind a coupling); contacts, cuts and grips read its pose at the beginning and the end of the
// step and its shape, and give it the tissue's forces.
class Tool : public Component {
 public:
  static constexpr std::string_view role = "Tool";

  [[nodiscard]] virtual const Pose& previousPose() const = 0;
  [[nodiscard]] virtual const Pose& pose() const = 0;
  [[nodiscard]] virtual const Vec3& linearVelocity() const = 0;   // m/s
  [[nodiscard]] virtual const Vec3& angularVelocity() const = 0;  // rad/s
  // Trigger held: a grip holds, a blade may cut.
  [[nodiscard]] virtual bool active() const = 0;

  // Points, in the tool's frame, where it touches, each a sphere of radius() (m, may be 0).
  [[nodiscard]] virtual std::span<const Vec3> samplePoints() const = 0;
  [[nodiscard]] virtual double radius() const = 0;
  // Cutting edge as a polyline in the tool's frame, whose handle lies towards +z; empty for tools
  // that do not cut. It runs from heel to tip, on to the other heel if the blade has two sides, or
  // round to where it began if it is a ring.
  [[nodiscard]] virtual std::span<const Vec3> edge() const = 0;
  // The way in which the edge cuts, a unit vector in the tool's frame; zero where it cuts in all.
  [[nodiscard]] virtual Vec3 cuttingDirection() const { return Vec3::Zero(); }

  // Whether the edge is inside the tissue: set by who cuts, read by who responds to contact, to
  // which none of the tool's samples then touches anything.
  [[nodiscard]] virtual bool cutting() const = 0;
  virtual void setCutting(bool cutting) = 0;

  // The contacts of the step, from who responds to them; they stand until the next ones.
  virtual void setContacts(std::span<const Contact> contacts) = 0;
  [[nodiscard]] virtual std::span<const Contact> contacts() const = 0;
  // Forces (N) at points of the scene that are no contacts, such as a cut's resistance or a grip's
  // pull; they sum up until clearForces(), which the tool's mover calls once a step.
  virtual void addForce(const Vec3& force, const Vec3& at) = 0;
  virtual void clearForces() = 0;
  // All forces on the tool, contacts included, and their torque about its origin.
  [[nodiscard]] virtual Vec3 totalForce() const = 0;
  [[nodiscard]] virtual Vec3 totalTorque() const = 0;

  // The pose at the end of the step that is being made, from whoever moves the tool; the former
  // one becomes the previous pose. Called once a step, in Stage::Input.
  virtual void moveTo(const Pose& pose, const Vec3& linearVelocity, const Vec3& angularVelocity,
                      bool active) = 0;
  // Somebody else than the tool itself reads its device and calls moveTo() and clearForces() (a
  // haptic controller does); said before the schedule is compiled, in bind().
  virtual void setDriven(bool driven) = 0;
};

}  // namespace stroma
