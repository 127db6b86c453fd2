// SPDX-License-Identifier: Apache-2.0
#include "components/collision/bvh_collision_model.h"
#include "components/collision/grip_contact.h"
#include "components/collision/penalty_contact.h"
#include "core/plugin.h"

PLUGIN(collision, "0.1.0", "Apache-2.0", "Contact of tools with surfaces.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<BVHCollisionModel>("BVHCollisionModel")
      .doc("A triangle surface that tools can touch: a tree of boxes, refitted as it moves.")
      .domain(
          "Any triangle surface, open or closed. Queries verified against brute force on random "
          "moving meshes.")
      .example("scenes/cornea/touch.xml");
  registry.add<PenaltyContactForceField>("PenaltyContactForceField")
      .doc("Contact of tools with a surface: penalty or constraint, and Coulomb friction.")
      .domain(
          "Rigid tools as samples against triangles; blade edges are not tested between samples. "
          "Force verified against its energy, the third law to rounding.")
      .example("scenes/cornea/touch.xml");
  registry.add<GripContact>("GripContact")
      .doc("Forceps on a surface: holds the nodes near a tool's tip while its trigger is held.")
      .domain("Linear springs in the tool's frame. Force verified against the energy.")
      .example("scenes/tutorials/tools.xml");
}
