// SPDX-License-Identifier: Apache-2.0
// Stops a run at the first position or velocity that is not finite, and finds out where it came from.
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

  // Checks positions and velocities after a step; one pass. While all are finite they are kept as the
  // last good state (for systems of up to 200,000 particles; larger ones keep only the check).
  [[nodiscard]] std::optional<Divergence> check(std::uint64_t step, double time, double dt);
  // Puts the last good state back where one is kept.
  bool restoreLastGood();
  // The state was changed from outside (restored, reset): it is good.
  void accept();

 private:
  [[nodiscard]] std::optional<Divergence> explain(std::uint64_t step, double time, double dt);
  System* system_;
  bool keeps_;
  std::vector<Vec3> x_, v_;
};

}  // namespace stroma
