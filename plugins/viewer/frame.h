// SPDX-License-Identifier: Apache-2.0
// Copies of what is to be seen, on their way from the thread that makes the steps to the one that
// serves. Positions in m, in the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/interfaces/tool.h"

namespace stroma::viewer {

// The points of a body at rest and, of a surface, its triangles.
struct TopologyCopy {
  std::uint64_t generation = 0;  // of the scene
  int body = 0;
  std::uint64_t revision = 0;
  std::vector<float> rest;               // 3 a point
  std::vector<std::uint32_t> triangles;  // 3 each; empty for particles
  std::vector<std::uint8_t> walls;       // 1 a triangle, or none
  std::vector<float> texture;            // 2 a point, or none
};

struct FieldCopy {
  std::string name;
  std::vector<float> values;  // 1 a point
};

struct BodyCopy {
  int body = 0;
  std::uint64_t revision = 0;
  std::vector<float> positions;  // 3 a point
  std::vector<FieldCopy> fields;
};

struct ToolCopy {
  std::string path;
  Pose pose;
  bool active = false;
  Vec3 force = Vec3::Zero();
  std::vector<Contact> contacts;
};

struct FrameCopy {
  std::uint64_t generation = 0, step = 0;
  double time = 0;
  std::vector<BodyCopy> bodies;
  std::vector<ToolCopy> tools;
};

}  // namespace stroma::viewer
