// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/tools/rigid_tool.h"

namespace stroma {

// A scalpel, as the cornea paper has it: a segment of the blade's length, `sampleCount` points
// spread evenly on its central axis from the tip upwards. The blade is the flat triangle between
// the tip and its upper end, `width` wide there, in the plane y = 0; it cuts towards +x. With
// width 0 it is the paper's line without thickness, and that line is its edge.
class ScalpelTool final : public RigidTool {
 public:
  Attribute<double> length{this,
                           "length",
                           0.0,
                           "Length of the blade from the tip upwards.",
                           {.unit = "m", .min = 0, .exclusiveMin = true, .required = true}};
  Attribute<double> width{
      this, "width", 0.0, "Width of the blade at its upper end.", {.unit = "m", .min = 0}};
  Attribute<int> sampleCount{
      this, "sampleCount", 10, "Points on the central axis where it touches.", {.min = 1}};

  [[nodiscard]] Vec3 cuttingDirection() const override {
    return width > 0 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::Zero());
  }

  void bind() override {
    samples_ = evenPoints(Vec3::Zero(), Vec3(0, 0, length), sampleCount);
    edge_ = {Vec3(0.5 * width, 0, length), Vec3::Zero()};
    RigidTool::bind();
  }
};

}  // namespace stroma
