// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/attribute.h"
#include "core/interfaces/tool.h"

namespace stroma {

// What all rigid instruments share: who moves them, their forces and what they show of both.
//
// The tool's frame is the device's stylus: its tip is the origin, the handle lies towards +z, a
// blade lies in the plane y = 0. The tool takes the device's pose at the end of the step in
// Stage::Input and gives the device the total force in Stage::Publish. Where a haptic controller
// drives it, it does neither, and a device given to it is an error. Velocities that a device leaves
// at zero while its pose moves are those of the motion over the step.
//
// A pose that is not finite moves nothing: the tool stands still for that step, which is counted.
class RigidTool : public Tool {
 public:
  Link<HapticDevice> device{this,
                            "device",
                            "What moves the tool and feels its force. Must not be given where a "
                            "haptic controller drives it; else, without, it rests at the origin.",
                            Lookup::explicitOnly,
                            {.required = false}};
  Attribute<Vec3> position{
      this, "position", Vec3::Zero(), "Position of the tip.", {.unit = "m", .output = true}};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force of the tissue on the tool, at the end of the step.",
                        {.unit = "N", .output = true}};
  Attribute<Vec3> torque{
      this, "torque", Vec3::Zero(), "Its torque about the tip.", {.unit = "N m", .output = true}};
  Attribute<int> contactCount{this,
                              "contactCount",
                              0,
                              "Number of points where the tool presses the tissue.",
                              {.output = true}};

  [[nodiscard]] const Pose& previousPose() const override { return motion_.previous; }
  [[nodiscard]] const Pose& pose() const override { return motion_.pose; }
  [[nodiscard]] const Vec3& linearVelocity() const override { return motion_.linearVelocity; }
  [[nodiscard]] const Vec3& angularVelocity() const override { return motion_.angularVelocity; }
  [[nodiscard]] bool active() const override { return active_; }
  [[nodiscard]] std::span<const Vec3> samplePoints() const override { return samples_; }
  [[nodiscard]] double radius() const override { return 0; }
  [[nodiscard]] std::span<const Vec3> edge() const override { return edge_; }
  [[nodiscard]] bool cutting() const override { return cutting_; }
  void setCutting(bool cutting) override { cutting_ = cutting; }

  void setContacts(std::span<const Contact> contacts) override;
  [[nodiscard]] std::span<const Contact> contacts() const override { return contacts_; }
  void addForce(const Vec3& force, const Vec3& at) override;
  void clearForces() override;
  [[nodiscard]] Vec3 totalForce() const override { return *force; }
  [[nodiscard]] Vec3 totalTorque() const override { return *torque; }
  void moveTo(const Pose& pose, const Vec3& linearVelocity, const Vec3& angularVelocity,
              bool active) override;
  void setDriven(bool driven) override { driven_ = driven; }

  void bind() override;
  void start() override;
  void reset() override { start(); }
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 protected:
  // In the tool's frame, set by the kinds of tools in bind().
  std::vector<Vec3> samples_{Vec3::Zero()}, edge_;

 private:
  // Plain numbers, so that a checkpoint takes them as they are.
  struct Motion {
    Pose previous, pose;
    Vec3 linearVelocity = Vec3::Zero(), angularVelocity = Vec3::Zero();
  };
  void readDevice(const StepContext& step);
  void writeDevice(const StepContext& step);
  void show();

  Motion motion_;
  std::vector<Contact> contacts_;
  Vec3 otherForce_ = Vec3::Zero(), otherTorque_ = Vec3::Zero();  // not of contacts
  bool active_ = false, cutting_ = false, driven_ = false, placed_ = false;
  Limiter badPoses_{this, "badPoses", "Poses that were not finite and moved nothing."};
};

// Points from `from` to `to`, both included, evenly spaced; only `from` for a count of 1.
[[nodiscard]] std::vector<Vec3> evenPoints(const Vec3& from, const Vec3& to, int count);

}  // namespace stroma
