// SPDX-License-Identifier: Apache-2.0
#include "components/mass/diagonal_mass.h"

#include <algorithm>
#include <numeric>

namespace stroma {

void DiagonalMass::configure() {
  const int given = massDensity.isSet() + totalMass.isSet() + vertexMass.isSet();
  if (given != 1) {
    error("attr-required", std::string("needs one of 'massDensity', 'totalMass' and 'vertexMass'") +
                               (given ? ", not several" : ""));
  }
}

void DiagonalMass::bind() {
  const auto particles = static_cast<std::size_t>(mechanicalState->size());
  if (vertexMass.isSet()) {
    mass_ = vertexMass;
    if (mass_.size() != particles) {
      error(vertexMass, "mass-size",
            "has " + std::to_string(mass_.size()) + " values for " + std::to_string(particles) +
                " particles");
    }
    return;
  }
  mass_ = volume;
  if (mass_.empty() && topology) {
    mass_.assign(topology->volumes().begin(), topology->volumes().end());
  }
  if (mass_.size() != particles) {
    error("mass-volume",
          "knows " + std::to_string(mass_.size()) + " volumes for " + std::to_string(particles) +
              " particles",
          "volumes come from a ParticleSampler, a RegularGridTopology, a MeshTopology's elements "
          "or 'volume'");
    return;
  }
  const double all = std::accumulate(mass_.begin(), mass_.end(), 0.0);
  const double density = massDensity.isSet() ? *massDensity : *totalMass / all;
  for (double& m : mass_) m *= density;
}

void DiagonalMass::addMasses(std::span<double> masses) const {
  std::ranges::transform(masses, mass_, masses.begin(), std::plus());
}

}  // namespace stroma
