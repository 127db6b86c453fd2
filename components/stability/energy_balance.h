// SPDX-License-Identifier: Apache-2.0
// Whether a motion gains energy that nobody has put in. What loads, tools and cuts do between the
// steps counts as their work: it is the change of the energy while no particle moves.
#pragma once

namespace stroma {

struct MechanicalEnergy {
  double kinetic = 0, potential = 0;  // J
  [[nodiscard]] double total() const { return kinetic + potential; }
};

class EnergyBalance {
 public:
  void begin(const MechanicalEnergy& start);
  // The loads have moved on, the particles have not: what the energy is now.
  void loadsMoved(const MechanicalEnergy& now);
  // The particles have moved.
  void moved(const MechanicalEnergy& now);

  // All in J, of the last step: energy without the work of loads over that at the start, over the
  // least so far; and the work.
  [[nodiscard]] double growth() const { return own_ - start_; }
  [[nodiscard]] double rise() const { return own_ - least_; }
  [[nodiscard]] double work() const { return work_; }
  // What these are measured by: the largest kinetic energy, or the largest change of the potential
  // one, so far.
  [[nodiscard]] double scale() const;

 private:
  double start_ = 0, least_ = 0, own_ = 0, last_ = 0, work_ = 0;
  double kinetic_ = 0, high_ = 0, low_ = 0;  // largest kinetic, bounds of the potential energy
};

}  // namespace stroma
