// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/xpbd/xpbd_constraint.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// Constraints on the elements of a topology: what all kinds of them have in common.
class XpbdMeshConstraint : public XpbdConstraint {
 public:
  static constexpr std::string_view role = "XpbdMeshConstraint";

  Attribute<double> damping{
      this,
      "damping",
      0.0,
      "Time whose product with the stiffness of a constraint is its damping coefficient.",
      {.unit = "s", .min = 0, .runtime = true}};
  Attribute<int> colours{this,
                         "colours",
                         0,
                         "Groups of elements without a common node, taken one after the other.",
                         {.output = true}};

  Link<MechanicalState> mechanicalState{
      this, "state", "Particles.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Where the elements come from.", Lookup::sameNode};

  // Errors where another solver than XPBDSolver has the particles, or a tool divides them.
  void start() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }

 protected:
  // A warning for particles that none of the elements has.
  void warnOfLoose(std::span<const Index> nodes);

  Limiter skipped_{this, "skipped",
                   "projections left out because an element had collapsed or was not finite"};
};

}  // namespace stroma
