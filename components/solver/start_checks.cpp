// SPDX-License-Identifier: Apache-2.0
#include "components/solver/start_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stroma {

void requireMasses(Component& integrator, const System& system) {
  const Index massless = system.masslessParticle();
  if (massless < 0) return;
  integrator.error("mass-zero", "needs masses, but " + system.particleName(massless) + " has none",
                   "add a UniformMass or a DiagonalMass to the node of the state");
}

double typicalDistance(ConstVec3Span points) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 32);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    for (const Vec3& p : points) {
      const double d = (p - points[i]).squaredNorm();
      if (d > 0) least = std::min(least, d);
    }
  }
  return std::sqrt(least);
}

}  // namespace stroma
