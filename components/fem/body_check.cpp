// SPDX-License-Identifier: Apache-2.0
#include "components/fem/body_check.h"

#include "core/interfaces/topology_modifier.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {

bool checkSizes(Component& component, const Link<Topology>& link, const MechanicalState& state) {
  const auto points = static_cast<Index>(link->positions().size());
  if (points == state.size()) return true;
  component.error(link, "element-points",
                  "'" + link->path() + "' has " + std::to_string(points) + " points, '" +
                      state.path() + "' has " + std::to_string(state.size()) + " particles",
                  "elements connect particles by their numbers: let the state take its positions "
                  "from the topology");
  return false;
}

void refuseCuts(Component& component, const MechanicalState& state, const Topology& topology) {
  for (const TopologyModifier* modifier : collect<TopologyModifier>(component.scene().root())) {
    const bool same = &modifier->particles() == &state || &modifier->nodes() == &state ||
                      &modifier->surface() == &topology;
    if (!same) continue;
    component.error("element-cut",
                    "does not follow cuts, and '" + modifier->path() + "' divides this body",
                    "MLSForceField follows them; youngModulus, poissonRatio, material and strain "
                    "mean the same there");
  }
}

void warnOfLooseNodes(Component& component, Index loose, Index all, std::string_view what) {
  if (loose == 0) return;
  component.warning("node-loose", std::to_string(loose) + " of " + std::to_string(all) +
                                      " particles belong to no " + std::string(what) +
                                      ": it exerts no force on them");
}

}  // namespace stroma
