// SPDX-License-Identifier: Apache-2.0
// Random bodies: where their points come from, and their surfaces.
#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/random_scenes/dice.h"
#include "tests/fuzz/random_scenes/element.h"

namespace stroma::fuzz {

struct RandomBody {
  std::vector<Element> elements;  // before the state, which is among them
  Vec3 low = Vec3::Zero();        // bounds, roughly
  double length = 0.1;            // m, the longest side
  int particles = 1;              // at least
  bool hasElements = false;       // tetrahedra or hexahedra
  std::string surface;            // mesh with triangles round the particles, "" where there is none
  bool canBeCut = false;          // an open sheet, or a solid of tetrahedra
  std::string solid;              // tetrahedra within that surface, "" where there are none
};

struct Surface {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

// A closed surface: a ball that was stretched and dented.
[[nodiscard]] Surface randomBlob(Dice& dice, double length);
// An open one, roughly across z.
[[nodiscard]] Surface randomSheet(Dice& dice, double length);

// `odd`: also duplicates, rows, layers, torn meshes.
[[nodiscard]] RandomBody randomBody(Dice& dice, bool odd);

}  // namespace stroma::fuzz
