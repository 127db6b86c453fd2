// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/tools/key_poses.h"
#include "core/attribute.h"
#include "core/channel.h"
#include "core/schedule.h"

namespace stroma {

// What a hand is given to feel.
struct FeltForce {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // N, N m
};

// A device whose stylus follows a script: poses at key times, given here or in a CSV file
// (time,x,y,z[,qx,qy,qz,qw][,buttons]; seconds, metres, unit quaternions; # starts a comment line).
// Between the keys the position is linear and the orientation turns at constant speed; velocities
// are the exact derivatives. The force that the hand would feel is kept as an output; in real time,
// where a haptic thread writes it, the outputs show the newest one at the end of each step.
class ScriptedDevice final : public HapticDevice {
 public:
  Attribute<std::vector<double>> keyTimes{
      this, "keyTimes", {}, "Times of the poses, rising.", {.unit = "s"}};
  Attribute<std::vector<Vec3>> positions{
      this, "positions", {}, "Position of the stylus at each key time.", {.unit = "m"}};
  Attribute<std::vector<double>> orientations{
      this,
      "orientations",
      {},
      "Orientation at each key time, or one for all: unit quaternions x y z w."};
  Attribute<std::vector<Vec3>> rotations{
      this,
      "rotations",
      {},
      "Orientation at each key time, or one for all, as angles about x, then the fixed y, then "
      "the fixed z, as SOFA has them.",
      {.unit = "deg"}};
  Attribute<std::vector<int>> buttons{
      this,
      "buttons",
      {},
      "Buttons held from each key time on; bit 0 is the trigger that closes grips and lets blades "
      "cut. Not given = none.",
      {.min = 0}};
  Attribute<FilePath> filename{
      this, "filename", {}, "CSV file with the poses, instead of the attributes above."};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force last written to the device.",
                        {.unit = "N", .output = true}};
  Attribute<Vec3> torque{this,
                         "torque",
                         Vec3::Zero(),
                         "Torque last written to the device.",
                         {.unit = "N m", .output = true}};

  void bind() override;
  void schedule(Schedule& schedule) override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] ToolSample read(double time) noexcept override;
  void write(double time, const Vec3& force, const Vec3& torque) noexcept override;

  [[nodiscard]] std::span<const KeyPose> keys() const { return keys_; }

 private:
  void readFile();
  void takeAttributes();
  [[nodiscard]] bool hasCount(const AttributeBase& attribute, std::size_t count, bool oneForAll);

  void show(const FeltForce& felt);
  void showNewest(const StepContext& step);

  std::vector<KeyPose> keys_;
  std::uint64_t sequence_ = 0;  // of whoever reads
  bool realTime_ = false;       // reading and writing are then the haptic thread's
  TripleBuffer<FeltForce> felt_;
};

}  // namespace stroma
