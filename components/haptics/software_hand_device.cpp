// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/software_hand_device.h"

#include <algorithm>
#include <cmath>

#include "core/scene.h"

namespace stroma {
namespace {

constexpr double longestSubstep = 5e-5;  // s
constexpr double longestAdvance = 1;     // s, so that a tick stays short after a halt

}  // namespace

void SoftwareHandDevice::bind() {
  if (positions->empty()) {
    error(positions, "value-count", "has no position");
  } else if (keyTimes->size() != positions->size() &&
             !(keyTimes->empty() && positions->size() == 1)) {
    error(keyTimes, "value-count",
          "has " + std::to_string(keyTimes->size()) + " times for " +
              std::to_string(positions->size()) + " positions");
  } else if (std::ranges::adjacent_find(*keyTimes, std::greater_equal<>()) != keyTimes->end()) {
    error(keyTimes, "value-order", "must rise");
  } else if (!std::ranges::is_sorted(*pressed)) {
    error(pressed, "value-order", "must rise");
  }
  if (failed()) return;
  times_ = keyTimes->empty() ? std::vector<double>{0.0} : *keyTimes;
  places_ = positions;
  pressed_ = pressed;
  orientation_ = orientation;
  mass_ = mass;
  stiffness_ = stiffness;
  damping_ = damping;
  friction_ = friction;
  rest();
}

// In real time the hand is the haptic thread's, and goes on like any hand.
void SoftwareHandDevice::reset() {
  if (!scene().options().realTime) rest();
}

void SoftwareHandDevice::rest() {
  hand_ = {places_.front(), Vec3::Zero()};
  force_.setZero();
  time_ = 0;
  sequence_ = 0;
}

void SoftwareHandDevice::save(StateWriter& writer) const {
  if (scene().options().realTime) return;
  const std::array<Vec3, 3> vectors = {hand_.x, hand_.v, force_};
  writer.write("hand", ConstVec3Span(vectors));
  writer.write("time", time_);
  writer.write("sequence", sequence_);
}

void SoftwareHandDevice::restore(StateReader& reader) {
  if (scene().options().realTime) return;
  std::array<Vec3, 3> vectors;
  if (!reader.read("hand", Vec3Span(vectors)) || !reader.read("time", time_) ||
      !reader.read("sequence", sequence_)) {
    return;
  }
  hand_ = {vectors[0], vectors[1]};
  force_ = vectors[2];
}

SoftwareHandDevice::Motion SoftwareHandDevice::intention(double time) const noexcept {
  const auto after = std::ranges::upper_bound(times_, time);
  if (after == times_.begin()) return {places_.front(), Vec3::Zero()};
  if (after == times_.end()) return {places_.back(), Vec3::Zero()};
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const Vec3 velocity = (places_[i] - places_[i - 1]) / (times_[i] - times_[i - 1]);
  return {places_[i - 1] + (time - times_[i - 1]) * velocity, velocity};
}

// Backward Euler in substeps: calm for any mass and stiffness.
void SoftwareHandDevice::advance(double duration) noexcept {
  const int count = std::max(1, static_cast<int>(std::ceil(duration / longestSubstep - 1e-6)));
  const double h = duration / count;
  for (int i = 1; i <= count; ++i) {
    const Motion w = intention(time_ + i * h);
    const Vec3 push = stiffness_ * (w.x - hand_.x) + damping_ * w.v + force_;
    hand_.v =
        (mass_ * hand_.v + h * push) / (mass_ + h * (damping_ + friction_) + h * h * stiffness_);
    hand_.x += h * hand_.v;
  }
}

ToolSample SoftwareHandDevice::read(double time) noexcept {
  const double duration = time - time_;
  if (duration > 0) {
    // after a halt of the haptic thread only the end of it is gone through
    time_ = std::max(time_, time - longestAdvance);
    advance(time - time_);
    time_ = time;
  }
  ToolSample sample;
  sample.time = time;
  sample.pose = {hand_.x, orientation_};
  sample.linearVelocity = hand_.v;
  const auto passed = std::ranges::upper_bound(pressed_, time) - pressed_.begin();
  sample.buttons = static_cast<std::uint32_t>(passed % 2);
  sample.sequence = ++sequence_;
  return sample;
}

void SoftwareHandDevice::write(double, const Vec3& force, const Vec3&) noexcept { force_ = force; }

}  // namespace stroma
