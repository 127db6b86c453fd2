// SPDX-License-Identifier: Apache-2.0
#include "components/stability/energy_balance.h"

#include <algorithm>

namespace stroma {

void EnergyBalance::begin(const MechanicalEnergy& start) {
  start_ = least_ = own_ = last_ = start.total();
  work_ = 0;
  kinetic_ = start.kinetic;
  high_ = low_ = start.potential;
}

void EnergyBalance::loadsMoved(const MechanicalEnergy& now) {
  work_ += now.total() - last_;
  last_ = now.total();
}

void EnergyBalance::moved(const MechanicalEnergy& now) {
  last_ = now.total();
  least_ = std::min(least_, own_);
  own_ = last_ - work_;
  kinetic_ = std::max(kinetic_, now.kinetic);
  high_ = std::max(high_, now.potential);
  low_ = std::min(low_, now.potential);
}

double EnergyBalance::scale() const { return std::max(kinetic_, high_ - low_); }

}  // namespace stroma
