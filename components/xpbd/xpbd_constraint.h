// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// What a projection sees of the particles of one state in one sub-step.
struct XpbdParticles {
  Vec3Span x;                           // positions, which the projection moves (m)
  ConstVec3Span start;                  // positions at the beginning of the sub-step
  std::span<const double> inverseMass;  // 1/kg, 0 for held particles
  // Projectors of the particles that are held in some directions, null for the others; empty where
  // there are none.
  std::span<const Mat3* const> partlyHeld;
  double h;  // length of the sub-step (s)

  // The part of a gradient along which particle i can move.
  [[nodiscard]] Vec3 movable(Index i, const Vec3& gradient) const {
    if (partlyHeld.empty()) return gradient;
    const Mat3* projector = partlyHeld[static_cast<std::size_t>(i)];
    return projector ? Vec3(*projector * gradient) : gradient;
  }
};

// Compliant constraints C_j(x) of one kind between the particles of a state: an elastic energy
// sum_j k_j/2 C_j^2 in the form that XPBDSolver needs (Macklin, Müller, Chentanez 2016).
class XpbdConstraint : public Component {
 public:
  static constexpr std::string_view role = "XpbdConstraint";

  [[nodiscard]] virtual MechanicalState& state() const = 0;
  // Number of scalar constraints C_j.
  [[nodiscard]] virtual Index count() const = 0;
  // A sub-step begins: all multipliers are zero.
  virtual void clearMultipliers() = 0;
  // One Gauss-Seidel sweep: moves the particles by each of the constraints in turn.
  virtual void project(const XpbdParticles& particles) = 0;
};

}  // namespace stroma
