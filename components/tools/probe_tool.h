// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/tools/rigid_tool.h"

namespace stroma {

// A blunt probe: a sphere round the tip. It presses and never cuts.
class ProbeTool final : public RigidTool {
 public:
  Attribute<double> sphereRadius{this,
                                 "radius",
                                 0.0,
                                 "Radius of the sphere at the tip.",
                                 {.unit = "m", .min = 0, .exclusiveMin = true, .required = true}};
  [[nodiscard]] double radius() const override { return sphereRadius; }
};

}  // namespace stroma
