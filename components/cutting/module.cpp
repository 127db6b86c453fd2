// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutting_resistance.h"
#include "components/cutting/cutting_topology_modifier.h"
#include "core/plugin.h"

PLUGIN(cutting, "0.1.0", "Apache-2.0", "Cutting along blades.")
(stroma::Registry& registry) {
  registry.add<stroma::CuttingTopologyModifier>("CuttingTopologyModifier")
      .doc("Cuts a body along the edges of tools; incisions have walls, pieces come apart.")
      .domain(
          "Follows the blade to about 0.15 edge lengths of the mesh that is cut at its surface, to "
          "0.4 within. A blade that "
          "moves along its own edge cuts nothing.")
      .example("scenes/cornea/cut.xml");
  registry.add<stroma::CuttingResistance>("CuttingResistance")
      .doc("The force that cutting takes, on the blade and on the tissue.")
      .domain(
          "One force for each piece of the edge that is inside; its factor is found once a step.")
      .example("scenes/cornea/keratome.xml");
}
