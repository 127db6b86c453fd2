// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types.h"

namespace stroma {

class MechanicalState;
class StateReader;
class StateWriter;
class System;

// Energy that a change of links has added to a body, taken back from the motion beside the cut: the
// velocities of the particles concerned are drawn towards their common rigid motion, which keeps
// linear and angular momentum, until what they lose has paid for it. What the motion does not hold
// at the time is owed on and paid in the next steps.
class EnergyDebt {
 public:
  // Joules (> 0) and the particles beside the change, ascending.
  void owe(double energy, std::span<const Index> particles);
  // Changes the velocities of `state`, which is an independent one of the system.
  void pay(System& system, const MechanicalState& state);
  void clear() { *this = {}; }

  [[nodiscard]] double owed() const { return owed_; }  // J
  [[nodiscard]] double paid() const { return paid_; }  // J, since the start

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  double owed_ = 0, paid_ = 0;
  std::vector<Index> particles_;
};

}  // namespace stroma
