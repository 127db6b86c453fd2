// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_mesh_constraint.h"

#include <algorithm>

#include "components/xpbd/xpbd_solver.h"
#include "core/interfaces/topology_modifier.h"
#include "core/scene.h"
#include "core/traverse.h"

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
  for (const TopologyModifier* modifier : collect<TopologyModifier>(scene().root())) {
    const bool same = &modifier->particles() == &*mechanicalState ||
                      &modifier->nodes() == &*mechanicalState || &modifier->surface() == &*topology;
    if (!same) continue;
    error("element-cut", "does not follow cuts, and '" + modifier->path() + "' divides this body",
          "MLSForceField follows them, with EulerExplicitSolver or EulerImplicitSolver");
  }
}

bool XpbdMeshConstraint::checkElements(std::size_t count, std::string_view plural) {
  if (count == 0) {
    error(topology, "element-none", "'" + topology->path() + "' has no " + std::string(plural));
    return false;
  }
  const auto points = static_cast<Index>(topology->positions().size());
  if (points == mechanicalState->size()) return true;
  error(topology, "element-points",
        "'" + topology->path() + "' has " + std::to_string(points) + " points, '" +
            mechanicalState->path() + "' has " + std::to_string(mechanicalState->size()) +
            " particles",
        "elements connect particles by their numbers: let the state take its positions from the "
        "topology");
  return false;
}

void XpbdMeshConstraint::warnOfLooseNodes(std::span<const Index> nodes) {
  std::vector<bool> used(static_cast<std::size_t>(mechanicalState->size()));
  for (const Index i : nodes) used[static_cast<std::size_t>(i)] = true;
  const auto loose = std::ranges::count(used, false);
  if (loose == 0) return;
  warning("node-loose", std::to_string(loose) + " of " + std::to_string(used.size()) +
                            " particles belong to no element: it does not hold them");
}

}  // namespace stroma
