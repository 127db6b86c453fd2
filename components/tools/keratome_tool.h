// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/tools/rigid_tool.h"

namespace stroma {

// A keratome (slit knife): a flat arrow head in the plane y = 0 that tapers from its full width at
// the shoulders to the tip and cuts with both sides, so that pushed in along its axis it leaves an
// incision as wide as it is. The edge runs from the shoulder at +x over the tip to that at -x;
// `sampleCount` points are spread evenly on the central axis from the tip to the shoulders.
class KeratomeTool final : public RigidTool {
 public:
  Attribute<double> width{this,
                          "width",
                          2.75e-3,
                          "Width at the shoulders, which the incision gets.",
                          {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<double> length{this,
                           "length",
                           3e-3,
                           "Length from the tip to the shoulders.",
                           {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<int> sampleCount{
      this, "sampleCount", 10, "Points on the central axis where it touches.", {.min = 1}};

  [[nodiscard]] Vec3 cuttingDirection() const override { return -Vec3::UnitZ(); }

  void bind() override {
    samples_ = evenPoints(Vec3::Zero(), Vec3(0, 0, length), sampleCount);
    edge_ = {Vec3(0.5 * width, 0, length), Vec3::Zero(), Vec3(-0.5 * width, 0, length)};
    RigidTool::bind();
  }
};

}  // namespace stroma
