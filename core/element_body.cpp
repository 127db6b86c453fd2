// SPDX-License-Identifier: Apache-2.0
#include "core/element_body.h"

#include "core/interfaces/topology_modifier.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {

bool checkPoints(Component& component, const Link<Topology>& link, const MechanicalState& state) {
  const auto points = static_cast<Index>(link->positions().size());
  if (points == state.size()) return true;
  component.error(link, "element-points",
                  "'" + link->path() + "' has " + std::to_string(points) + " points, '" +
                      state.path() + "' has " + std::to_string(state.size()) + " particles",
                  "elements connect particles by their numbers: let the state take its positions "
                  "from the topology");
  return false;
}

bool checkElements(Component& component, const Link<Topology>& link, const MechanicalState& state,
                   std::size_t count, std::string_view plural) {
  if (count > 0) return checkPoints(component, link, state);
  component.error(link, "element-none", "'" + link->path() + "' has no " + std::string(plural));
  return false;
}

void refuseFlaw(Component& component, const Link<Topology>& link, const ElementFlaw& flaw,
                std::size_t count, std::string_view plural, std::span<const Index> nodes,
                std::string_view order) {
  std::string list;
  for (const Index i : nodes) list += (list.empty() ? "" : " ") + std::to_string(i);
  component.error(link, "element-inverted",
                  "'" + link->path() + "' has " + std::to_string(flaw.count) + " of " +
                      std::to_string(count) + " " + std::string(plural) +
                      " inverted or without volume; the first is number " +
                      std::to_string(flaw.first) + " (" + list + ")",
                  std::string(order));
}

void refuseCuts(Component& component, const MechanicalState& state, const Topology& topology,
                std::string hint) {
  for (const TopologyModifier* modifier : collect<TopologyModifier>(component.scene().root())) {
    const bool same = &modifier->particles() == &state || &modifier->nodes() == &state ||
                      &modifier->surface() == &topology;
    if (!same) continue;
    component.error("element-cut",
                    "does not follow cuts, and '" + modifier->path() + "' divides this body", hint);
  }
}

void warnOfLooseParticles(Component& component, Index loose, Index all, std::string_view what) {
  if (loose == 0) return;
  component.warning("node-loose", std::to_string(loose) + " of " + std::to_string(all) +
                                      " particles belong to no " + std::string(what) +
                                      ": it does nothing to them");
}

}  // namespace stroma
