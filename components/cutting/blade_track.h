// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/cutting/blade_course.h"
#include "components/cutting/rest_placement.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/tool.h"

namespace stroma {

// The edge of one tool, drawn back to the rest configuration of a body step by step. Where no
// particles are around, the edge goes on rigidly from its nearest point that has some.
class BladeTrack {
 public:
  // `count`: points of the edge, spread evenly on each of its segments.
  explicit BladeTrack(int count) : count_(count) {}

  // Once a step; false where no particle is near. A tool that is far costs nothing until it may
  // have come near.
  [[nodiscard]] bool follow(const Tool& tool, const MechanicalState& particles,
                            const RestPlacement& placement);
  // The points in the tool's frame.
  [[nodiscard]] std::vector<Vec3> points(const Tool& tool) const;

  std::vector<Vec3> edge;    // at rest, empty if not near
  std::vector<Vec3> before;  // and in the step before
  double clearance = 0;      // way that the tool can go without coming near [m]

 private:
  [[nodiscard]] bool comesNear(const Tool& tool, ConstVec3Span now,
                               const MechanicalState& particles, double reach);
  int count_;
};

}  // namespace stroma
