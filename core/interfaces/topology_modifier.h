// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/topology_change.h"

namespace stroma {

// Divides a body while the scene runs. In Stage::Topology it makes at most one TopologyChange and
// hands it to Scene::changeTopology, which lets everything follow. A body has one modifier.
class TopologyModifier : public Observer {
 public:
  static constexpr std::string_view role = "TopologyModifier";

  [[nodiscard]] virtual MechanicalState& particles() const = 0;
  [[nodiscard]] virtual MechanicalState& nodes() const = 0;
  [[nodiscard]] virtual Topology& surface() const = 0;

  // What is wrong with the body now, in its surface and in what components keep of it; nothing is
  // how it should be. Slow.
  [[nodiscard]] virtual TopologyCheck check() const = 0;
  // Makes the changes of a saved run again, each as it was, through Scene::changeTopology. The body
  // is whole when it is called, before positions are restored. restore() is called later as usual.
  virtual void replay(StateReader& reader) = 0;
};

}  // namespace stroma
