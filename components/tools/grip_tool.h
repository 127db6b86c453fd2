// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/tools/rigid_tool.h"

namespace stroma {

// Forceps: while the trigger is held, a GripContact holds what surface it finds within `radius` of
// the tip. To whoever responds to contact it is a sphere of that radius, open or closed, that would
// push away what it holds: a grip is not meant to be among a contact's tools.
class GripTool final : public RigidTool {
 public:
  Attribute<double> reach{this,
                          "radius",
                          0.0,
                          "Reach of the jaws round the tip.",
                          {.unit = "m", .min = 0, .exclusiveMin = true, .required = true}};
  [[nodiscard]] double radius() const override { return reach; }
};

}  // namespace stroma
