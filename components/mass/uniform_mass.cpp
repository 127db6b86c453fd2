// SPDX-License-Identifier: Apache-2.0
#include "components/mass/uniform_mass.h"

namespace stroma {

void UniformMass::configure() {
  if (!totalMass.isSet() && !vertexMass.isSet()) {
    error("attr-required", "needs 'totalMass' or 'vertexMass' (nothing weighs 1 kg by default)");
  }
  if (totalMass.isSet() && vertexMass.isSet()) {
    error(vertexMass, "attr-conflict", "and 'totalMass' are both given: give one");
  }
}

void UniformMass::addMasses(std::span<double> masses) const {
  const double each =
      vertexMass.isSet() ? *vertexMass : *totalMass / static_cast<double>(masses.size());
  for (double& m : masses) m += each;
}

}  // namespace stroma
