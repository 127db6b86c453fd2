// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/block_matrix.h"
#include "core/interfaces/mechanical_state.h"

namespace stroma {

// Forces on the particles of one state. All spans are that state's own, never the whole system's.
class ForceField : public Component {
 public:
  static constexpr std::string_view role = "ForceField";

  [[nodiscard]] virtual MechanicalState& state() const = 0;

  // f += forces (N) at the trial state.
  virtual void addForce(const StateView& at, Vec3Span f) = 0;

  // Potential energy (J), zero for forces that have none. Line searches and energy checks use it.
  [[nodiscard]] virtual double potentialEnergy(const StateView& at) const = 0;

  // Prepares the derivatives at a state; the two functions below refer to the last one prepared.
  virtual void linearize(const StateView& at) = 0;
  // df += stiffness (df/dx) dx + damping (df/dv) dx.
  virtual void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                                 Vec3Span df) const = 0;

  // The same derivative as 3x3 blocks. A force field without them returns false from addPattern; a
  // direct solver then reaches it only through iterations.
  [[nodiscard]] virtual bool addPattern(BlockPattern&, Index /*offset*/) const { return false; }
  virtual void addTangent(BlockMatrix&, Index /*offset*/, double /*stiffness*/,
                          double /*damping*/) const {}

  // The other particles that the force on this one depends on; empty where that is not known.
  [[nodiscard]] virtual std::vector<Index> neighboursOf(Index /*particle*/) const { return {}; }
};

}  // namespace stroma
