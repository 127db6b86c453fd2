// SPDX-License-Identifier: Apache-2.0
// Stops a run at the first position or velocity that is not finite, and finds out where it came
// from.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/system.h"

namespace stroma {

struct Divergence {
  std::string component;  // path of the component that the trouble came from
  std::string particle;   // "/cornea/particles, particle 17"
  std::uint64_t step = 0;
  double time = 0;
  std::string message;  // the whole story in a sentence
};

class FiniteGuard {
 public:
  explicit FiniteGuard(System& system);

  // Checks positions and velocities after a step.
  [[nodiscard]] std::optional<Divergence> check(std::uint64_t step, double time, double dt);
  // Puts the last good state back where one is kept.
  bool restoreLastGood();
  // Keeps the present state as the last good one (systems of up to 200,000 particles; larger ones
  // are only checked).
  void accept();

 private:
  [[nodiscard]] std::optional<Divergence> explain(std::uint64_t step, double time, double dt);
  System* system_;
  bool keeps_;
  std::vector<Vec3> x_, v_;
};

}  // namespace stroma
