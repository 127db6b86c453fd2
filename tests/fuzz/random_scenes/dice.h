// SPDX-License-Identifier: Apache-2.0
// Random choices that are the same on every machine for the same seed.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/types.h"

namespace stroma::fuzz {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] bool chance(double probability) { return random_() < probability; }
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * random_(); }
  // Of all powers of ten alike.
  [[nodiscard]] double decades(double low, double high) {
    return low * std::pow(high / low, random_());
  }
  // Both ends included.
  [[nodiscard]] int whole(int low, int high) {
    return low + static_cast<int>(std::floor(random_() * (high - low + 1.0)));
  }
  [[nodiscard]] double sign() { return chance(0.5) ? 1 : -1; }
  [[nodiscard]] Vec3 vector(double low, double high) {
    const double x = uniform(low, high), y = uniform(low, high);
    return {x, y, uniform(low, high)};
  }
  template <class T>
  [[nodiscard]] const T& oneOf(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(whole(0, static_cast<int>(list.size()) - 1))];
  }
  [[nodiscard]] std::string oneOf(std::initializer_list<const char*> words) {
    return words.begin()[whole(0, static_cast<int>(words.size()) - 1)];
  }

 private:
  UniformRandom random_;
};

}  // namespace stroma::fuzz
