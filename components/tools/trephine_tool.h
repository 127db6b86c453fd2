// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "components/tools/rigid_tool.h"

namespace stroma {

// A trephine: a tube whose lower rim cuts a circle. The tip, the origin of its frame, is the middle
// of the rim, which lies in the plane z = 0; `sampleCount` points are spread evenly on the rim.
class TrephineTool final : public RigidTool {
 public:
  Attribute<double> diameter{this,
                             "diameter",
                             0.0,
                             "Diameter of the rim.",
                             {.unit = "m", .min = 0, .exclusiveMin = true, .required = true}};
  Attribute<int> edgePoints{this,
                            "edgePoints",
                            64,
                            "Corners of the polygon that stands for the rim.",
                            {.min = 8, .max = 10000}};
  Attribute<int> sampleCount{
      this, "sampleCount", 16, "Points on the rim where it touches.", {.min = 1}};

  [[nodiscard]] Vec3 cuttingDirection() const override { return -Vec3::UnitZ(); }

  void bind() override {
    samples_ = circle(sampleCount);
    edge_ = circle(edgePoints);
    edge_.push_back(edge_.front());  // a ring is closed
    RigidTool::bind();
  }

 private:
  [[nodiscard]] std::vector<Vec3> circle(int count) const {
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      points.push_back(0.5 * diameter * Vec3(std::cos(angle), std::sin(angle), 0));
    }
    return points;
  }
};

}  // namespace stroma
