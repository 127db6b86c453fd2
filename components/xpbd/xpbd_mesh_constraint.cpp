// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_mesh_constraint.h"

#include <algorithm>

#include "components/xpbd/xpbd_solver.h"
#include "core/element_body.h"
#include "core/scene.h"

namespace stroma {

void XpbdMeshConstraint::start() {
  const System* system = scene().systemOf(*mechanicalState);
  if (!system) return;  // reported at the state
  if (!dynamic_cast<const XpbdSolver*>(&system->integrator())) {
    error("xpbd-solver",
          "acts on '" + mechanicalState->path() + "', which '" + system->integrator().path() +
              "' (" + system->integrator().type() + ") moves",
          "only XPBDSolver solves such constraints; a force field such as "
          "TetrahedronHyperelasticityFEMForceField works with every solver");
  } else if (system->offsetOf(*mechanicalState) < 0) {
    error(mechanicalState, "xpbd-mapped",
          "acts on '" + mechanicalState->path() +
              "', which follows another state: constrain that one");
  }
  refuseCuts(*this, *mechanicalState, *topology,
             "MLSForceField follows them, with EulerExplicitSolver or EulerImplicitSolver");
}

void XpbdMeshConstraint::warnOfLoose(std::span<const Index> nodes) {
  std::vector<bool> used(static_cast<std::size_t>(mechanicalState->size()));
  for (const Index i : nodes) used[static_cast<std::size_t>(i)] = true;
  const auto loose = static_cast<Index>(std::ranges::count(used, false));
  warnOfLooseParticles(*this, loose, mechanicalState->size(), "element");
}

}  // namespace stroma
