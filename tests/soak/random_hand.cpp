// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/random_hand.h"

#include <cmath>
#include <numbers>

namespace stroma::soak {
namespace {

class Hand {
 public:
  explicit Hand(UniformRandom& random) : random_(random) {}

  [[nodiscard]] double between(double low, double high) { return low + (high - low) * random_(); }

  // A point at a height over the surface (m), a sphere of 7.8 mm about (0, 0, -7.8 mm).
  [[nodiscard]] static Vec3 over(double x, double y, double height) {
    constexpr double radius = 7.8e-3;
    return {x, y, std::sqrt(radius * radius - x * x - y * y) - radius + height};
  }
  [[nodiscard]] Vec3 somewhere(double within) {
    const double r = within * std::sqrt(random_()), angle = between(0, 2 * std::numbers::pi);
    return {r * std::cos(angle), r * std::sin(angle), 0};
  }
  void moveTo(const Vec3& point, double duration) {
    time_ += duration;
    path_.keyTimes += std::to_string(time_) + " ";
    for (int i = 0; i < 3; ++i) path_.positions += std::to_string(point[i]) + " ";
  }
  void moveOver(const Vec3& place, double height, double duration) {
    moveTo(over(place.x(), place.y(), height), duration);
  }
  void countGesture() { ++path_.gestures; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] HandPath path() { return std::move(path_); }

 private:
  UniformRandom& random_;
  double time_ = 0;
  HandPath path_;
};

}  // namespace

HandPath touchingHand(UniformRandom& random, double seconds) {
  Hand hand(random);
  do {
    const Vec3 from = hand.somewhere(4e-3), to = hand.somewhere(4e-3);
    const double depth = hand.between(-0.2e-3, 1.0e-3);  // of the tip; the ball's centre is higher
    hand.moveOver(from, 2e-3, hand.between(0.1, 0.4));
    hand.moveOver(from, -depth, hand.between(0.05, 0.3));
    hand.moveOver(from + hand.between(0, 0.5) * (to - from), -depth, hand.between(0.1, 0.6));
    hand.moveOver(to, 2e-3, hand.between(0.02, 0.2));
    hand.countGesture();
  } while (hand.time() < seconds - 2);
  return hand.path();
}

HandPath cuttingHand(UniformRandom& random, double seconds) {
  Hand hand(random);
  do {
    const Vec3 from = hand.somewhere(3.5e-3), middle = hand.somewhere(3.5e-3),
               to = hand.somewhere(3.5e-3);
    const double depth = hand.between(0.4e-3, 1.2e-3);
    hand.moveOver(from, 2e-3, hand.between(0.5, 2.5));
    hand.moveOver(from, -depth, hand.between(0.03, 0.2));
    if (random() < 0.5) hand.moveOver(middle, -depth, hand.between(0.1, 0.5));
    hand.moveOver(to, -depth, hand.between(0.1, 0.5));
    hand.moveOver(to, 2e-3, hand.between(0.03, 0.2));
    hand.countGesture();
  } while (hand.time() < seconds - 4);
  return hand.path();
}

}  // namespace stroma::soak
