// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/mouse_device.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/rigid_motion.h"
#include "core/scene.h"
#include "core/snapshot.h"

namespace stroma {

void MouseDevice::configure() {
  const std::vector<double>& q = orientation;
  const double length =
      q.size() == 4 ? std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) : 0.0;
  if (std::abs(length - 1) > 1e-3) {
    error(orientation, "value-quaternion", "is no unit quaternion x y z w");
  }
}

bool MouseDevice::follow(const MouseTarget& target) {
  const bool taken = path_.push(target);
  if (!taken) ++dropped_;
  return taken;
}

void MouseDevice::start() {
  realTime_ = scene().options().realTime;
  attributeChanged(maxSpeed);
  now_ = {};
  now_.pose.position = position;
  const std::vector<double>& q = orientation;
  now_.pose.orientation = Quat(q[3], q[0], q[1], q[2]).normalized();
  begun_ = false;
  keys_.clear();
}

void MouseDevice::reset() {
  force.set(Vec3::Zero());
  if (realTime_) return;
  dropTargets();
  start();
}

void MouseDevice::dropTargets() {
  path_.reset();
  hasTarget_ = false;
}

void MouseDevice::schedule(Schedule& schedule) {
  schedule.add<&MouseDevice::showForce>(Stage::Publish, *this, "newest force", Rate::visual);
}

void MouseDevice::attributeChanged(const AttributeBase&) {
  speed_ = maxSpeed;
  turnRate_ = maxTurnRate * std::numbers::pi / 180;
}

ToolSample MouseDevice::read(double time) noexcept {
  ToolSample sample;
  const double duration = time - now_.time;
  const Pose before = now_.pose;
  if (begun_ && duration > 0) {
    advance(duration);
    // the same expressions as of a scripted motion from key to key, so that a recording has its
    // bits
    sample.linearVelocity = (now_.pose.position - before.position) / duration;
    sample.angularVelocity = rotationVector(before.orientation, now_.pose.orientation) / duration;
  }
  now_.time = time;
  begun_ = true;
  if (!realTime_) record();
  sample.time = time;
  sample.pose = now_.pose;
  sample.buttons = now_.buttons;
  sample.sequence = ++sequence_;
  return sample;
}

void MouseDevice::advance(double duration) noexcept {
  double way = speed_ * duration, turn = turnRate_ * duration;
  while (hasTarget_ || path_.pop(target_)) {
    hasTarget_ = true;
    const Vec3 ahead = target_.pose.position - now_.pose.position;
    const Vec3 turnAhead = rotationVector(now_.pose.orientation, target_.pose.orientation);
    const double distance = ahead.norm(), angle = turnAhead.norm();
    // the part of both that this time allows, so that they end together
    const double part =
        target_.jump
            ? 1.0
            : std::min({1.0, distance > 0 ? way / distance : 1.0, angle > 0 ? turn / angle : 1.0});
    if (part < 1) {
      now_.pose.position += part * ahead;
      now_.pose.orientation = rotated(now_.pose.orientation, part * turnAhead).normalized();
      return;
    }
    const bool changes = now_.buttons != target_.buttons;
    now_.pose = target_.pose;
    now_.buttons = target_.buttons;
    hasTarget_ = false;
    // a trigger is pulled at its place, and after a jump there is no motion: the rest comes later
    if (changes || target_.jump) return;
    way -= distance;
    turn -= angle;
  }
}

void MouseDevice::record() {
  const auto same = [](const Key& a, const Key& b) {
    return a.pose.position == b.pose.position &&
           a.pose.orientation.coeffs() == b.pose.orientation.coeffs() && a.buttons == b.buttons;
  };
  const std::size_t n = keys_.size();
  if (n >= 1 && keys_.back().time >= now_.time)
    keys_.back() = now_;
  else if (n >= 2 && same(keys_[n - 1], now_) && same(keys_[n - 2], now_))
    keys_.back() = now_;
  else
    keys_.push_back(now_);
}

std::string MouseDevice::recording() const {
  std::string text;
  if (realTime_) return text;
  text = "time,x,y,z,qx,qy,qz,qw,buttons\n";
  std::array<char, 32> number;
  const auto put = [&](double value, char end) {
    const auto [last, failure] = std::to_chars(number.data(), number.data() + number.size(), value);
    text.append(number.data(), last) += end;
  };
  for (const Key& key : keys_) {
    put(key.time, ',');
    for (const double x : key.pose.position) put(x, ',');
    for (const double x : key.pose.orientation.coeffs()) put(x, ',');
    text += std::to_string(key.buttons) + "\n";
  }
  return text;
}

void MouseDevice::write(double, const Vec3& felt, const Vec3&) noexcept { felt_.write(felt); }

void MouseDevice::showForce(const StepContext&) {
  Vec3 newest;
  if (felt_.read(newest)) force.set(newest);
}

void MouseDevice::save(StateWriter& writer) const {
  if (realTime_) return;
  const auto& q = now_.pose.orientation.coeffs();
  const Vec3& p = now_.pose.position;
  const std::array<double, 9> state{
      now_.time, p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3], static_cast<double>(now_.buttons)};
  writer.write("stylus", std::span<const double>(state));
}

void MouseDevice::restore(StateReader& reader) {
  std::array<double, 9> state{};
  if (realTime_ || !reader.read("stylus", std::span<double>(state))) return;
  dropTargets();
  now_.time = state[0];
  now_.pose.position = {state[1], state[2], state[3]};
  now_.pose.orientation = Quat(state[7], state[4], state[5], state[6]);
  now_.buttons = static_cast<std::uint32_t>(state[8]);
  begun_ = true;
  // the recording forgets what was gone back over
  const auto later = [&](const Key& key) { return key.time > now_.time; };
  std::erase_if(keys_, later);
}

}  // namespace stroma
