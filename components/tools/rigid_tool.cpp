// SPDX-License-Identifier: Apache-2.0
#include "components/tools/rigid_tool.h"

#include "core/rigid_motion.h"
#include "core/schedule.h"
#include "core/snapshot.h"

namespace stroma {
namespace {

bool isFinite(const Pose& pose) {
  return pose.position.allFinite() && pose.orientation.coeffs().allFinite() &&
         pose.orientation.norm() > 0;
}

constexpr std::size_t motionSize = 7 + 7 + 3 + 3;
constexpr std::size_t contactSize = 16;

void put(std::vector<double>& to, const Vec3& a) { to.insert(to.end(), a.data(), a.data() + 3); }
void put(std::vector<double>& to, const Pose& pose) {
  put(to, pose.position);
  const auto& q = pose.orientation.coeffs();
  to.insert(to.end(), q.data(), q.data() + 4);
}

// Takes numbers back in the order in which they were put.
struct Taker {
  const double* at;
  [[nodiscard]] double number() { return *at++; }
  [[nodiscard]] Vec3 vec3() {
    const Vec3 a(at[0], at[1], at[2]);
    at += 3;
    return a;
  }
  [[nodiscard]] Pose pose() {
    Pose p;
    p.position = vec3();
    p.orientation = Quat(at[3], at[0], at[1], at[2]);
    at += 4;
    return p;
  }
};

}  // namespace

void RigidTool::bind() {
  contacts_.reserve(2 * samples_.size());
  position.set(motion_.pose.position);
}

void RigidTool::start() {
  motion_ = {};
  placed_ = active_ = cutting_ = false;
  contacts_.clear();
  clearForces();
  position.set(motion_.pose.position);
}

void RigidTool::schedule(Schedule& schedule) {
  if (driven_ && device) {
    error(device, "device-unread", "is not read: a controller moves this tool",
          "leave 'device' out here; the controller's own says whose hand it is");
  }
  if (!driven_ && !device) {
    warning("tool-still", "nobody moves this tool: it stands at the origin",
            "give it a 'device', or a HapticController that links to it");
  }
  if (driven_ || !device) return;
  schedule.add<&RigidTool::readDevice>(Stage::Input, *this, "pose of the device");
  schedule.add<&RigidTool::writeDevice>(Stage::Publish, *this, "force to the device");
}

void RigidTool::readDevice(const StepContext& step) {
  clearForces();
  if (!placed_) {  // the tool begins where the device is, not with a jump from the origin
    const Pose first = device->read(step.time).pose;
    if (isFinite(first)) moveTo(first, Vec3::Zero(), Vec3::Zero(), false);
  }
  const ToolSample sample = device->read(step.time + step.dt);
  Vec3 linear = sample.linearVelocity, angular = sample.angularVelocity;
  if (linear.isZero(0) && angular.isZero(0) && placed_ && isFinite(sample.pose)) {
    linear = (sample.pose.position - motion_.pose.position) / step.dt;
    angular = rotationVector(motion_.pose.orientation, sample.pose.orientation) / step.dt;
  }
  moveTo(sample.pose, linear, angular, (sample.buttons & 1u) != 0);
}

void RigidTool::writeDevice(const StepContext& step) {
  device->write(step.time, totalForce(), totalTorque());
}

void RigidTool::moveTo(const Pose& pose, const Vec3& linearVelocity, const Vec3& angularVelocity,
                       bool active) {
  if (!isFinite(pose) || !linearVelocity.allFinite() || !angularVelocity.allFinite()) {
    ++badPoses_;
    motion_.previous = motion_.pose;
    motion_.linearVelocity = motion_.angularVelocity = Vec3::Zero();
    return;
  }
  const Pose unit{pose.position, pose.orientation.normalized()};
  motion_.previous = placed_ ? motion_.pose : unit;
  motion_.pose = unit;
  motion_.linearVelocity = linearVelocity;
  motion_.angularVelocity = angularVelocity;
  active_ = active;
  placed_ = true;
  position.set(motion_.pose.position);
}

void RigidTool::setContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  show();
}

void RigidTool::addForce(const Vec3& f, const Vec3& at) {
  otherForce_ += f;
  otherTorque_ += (at - motion_.pose.position).cross(f);
  show();
}

void RigidTool::clearForces() {
  otherForce_ = otherTorque_ = Vec3::Zero();
  show();
}

// Whenever a force changes, so that the outputs are right whoever reads them, in any order.
void RigidTool::show() {
  Vec3 f = otherForce_, t = otherTorque_;
  int pressing = 0;
  for (const Contact& c : contacts_) {
    f += c.force;
    t += (c.point - motion_.pose.position).cross(c.force);
    if (c.depth > 0) ++pressing;
  }
  force.set(f);
  torque.set(t);
  contactCount.set(pressing);
}

void RigidTool::save(StateWriter& writer) const {
  std::vector<double> numbers;
  put(numbers, motion_.previous);
  put(numbers, motion_.pose);
  for (const Vec3* a :
       {&motion_.linearVelocity, &motion_.angularVelocity, &otherForce_, &otherTorque_}) {
    put(numbers, *a);
  }
  for (const Contact& c : contacts_) {
    for (const Vec3* a : {&c.point, &c.normal, &c.velocity, &c.force}) put(numbers, *a);
    numbers.insert(numbers.end(), {c.depth, c.stiffness, static_cast<double>(c.sample),
                                   static_cast<double>(c.triangle)});
  }
  writer.write("motion", std::span<const double>(numbers));
  writer.write("flags", (active_ ? 1 : 0) | (cutting_ ? 2 : 0) | (placed_ ? 4 : 0));
}

void RigidTool::restore(StateReader& reader) {
  std::vector<double> numbers(reader.count<double>("motion"));
  int flags = 0;
  constexpr std::size_t head = motionSize + 6;
  if (numbers.size() < head || (numbers.size() - head) % contactSize != 0) return;
  if (!reader.read("flags", flags) || !reader.read("motion", std::span<double>(numbers))) return;
  Taker take{numbers.data()};
  motion_.previous = take.pose();
  motion_.pose = take.pose();
  for (Vec3* a : {&motion_.linearVelocity, &motion_.angularVelocity, &otherForce_, &otherTorque_}) {
    *a = take.vec3();
  }
  contacts_.assign((numbers.size() - head) / contactSize, {});
  for (Contact& c : contacts_) {
    for (Vec3* a : {&c.point, &c.normal, &c.velocity, &c.force}) *a = take.vec3();
    c.depth = take.number();
    c.stiffness = take.number();
    c.sample = static_cast<Index>(take.number());
    c.triangle = static_cast<Index>(take.number());
  }
  active_ = (flags & 1) != 0;
  cutting_ = (flags & 2) != 0;
  placed_ = (flags & 4) != 0;
  position.set(motion_.pose.position);
  show();
}

std::vector<Vec3> evenPoints(const Vec3& from, const Vec3& to, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double s = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
    points.push_back((1 - s) * from + s * to);
  }
  return points;
}

}  // namespace stroma
