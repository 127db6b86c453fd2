// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// The directions in which one particle may move: increments are multiplied by the projector.
struct ParticleProjector {
  Index particle;  // in its state
  Mat3 projector;  // symmetric, idempotent; zero = held
};

// Holds particles, wholly or in some directions, by projecting every increment of velocity and
// position.
class ProjectiveConstraint : public Component {
 public:
  static constexpr std::string_view role = "ProjectiveConstraint";

  [[nodiscard]] virtual MechanicalState& state() const = 0;
  virtual void addProjectors(std::vector<ParticleProjector>& projectors) const = 0;
};

}  // namespace stroma
