// SPDX-License-Identifier: Apache-2.0
#include "components/solver/start_checks.h"

namespace stroma {

void requireMasses(Component& integrator, const System& system) {
  const Index massless = system.masslessParticle();
  if (massless < 0) return;
  integrator.error("mass-zero", "needs masses, but " + system.particleName(massless) + " has none",
                   "add a UniformMass or a DiagonalMass to the node of the state");
}

}  // namespace stroma
