// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// The particles of one body. Positions come from `position`, else from the topology of the node;
// they are transformed by scale, rotation (degrees, about x first, then y, then z: R = Rz Ry Rx)
// and translation, and are then the rest positions unless `rest_position` is given.
class MechanicalObject final : public MechanicalState {
 public:
  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Initial positions.", {.unit = "m", .autolink = true}};
  Attribute<std::vector<Vec3>> velocity{this,
                                        "velocity",
                                        {},
                                        "Initial velocities, zero if not given; "
                                        "one value holds for all.",
                                        {.unit = "m/s"}};
  Attribute<std::vector<Vec3>> restPosition{
      this, "rest_position", {}, "Rest positions, the initial ones if not given.", {.unit = "m"}};
  Attribute<Vec3> translation{
      this, "translation", Vec3::Zero(), "Shift of the initial positions.", {.unit = "m"}};
  Attribute<Vec3> rotation{
      this, "rotation", Vec3::Zero(),
      "Rotation of the initial positions about x, then y, then z, in degrees."};
  Attribute<Vec3> scale{
      this, "scale3d", Vec3::Ones(), "Scaling of the initial positions.", {.aliases = "scale"}};
  Link<Topology> topology{this,
                          "topology",
                          "Where positions come from when none are given.",
                          Lookup::sameNode,
                          {.required = false}};

  void bind() override;
};

}  // namespace stroma
