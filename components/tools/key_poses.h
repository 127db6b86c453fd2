// SPDX-License-Identifier: Apache-2.0
// Poses at given times and the motion between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/interfaces/haptic_device.h"
#include "core/source.h"

namespace stroma {

struct KeyPose {
  double time = 0;  // s
  Pose pose;
  std::uint32_t buttons = 0;  // from this time on
};

// Position linear, orientation along the shortest rotation at constant angular velocity (slerp,
// Shoemake 1985) between the keys; at rest before the first and after the last. Velocities are the
// exact derivatives; at a key, those of the piece that ends there. `keys` is not empty and rises.
[[nodiscard]] ToolSample sampleAt(std::span<const KeyPose> keys, double time);

// What is wrong with a table, and where.
struct TableProblem {
  SourceRange where;
  std::string message;
};

// Reads a table of key poses, a line each, columns separated by commas:
//
//   time,x,y,z[,qx,qy,qz,qw][,buttons]
//
// The first line that is neither empty nor a comment (#) names the columns, in this order. Seconds,
// metres, unit quaternions, whole numbers. Times rise.
[[nodiscard]] std::optional<TableProblem> readKeyPoses(std::shared_ptr<const SourceText> text,
                                                       std::vector<KeyPose>& keys);

}  // namespace stroma
