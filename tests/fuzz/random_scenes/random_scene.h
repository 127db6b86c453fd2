// SPDX-License-Identifier: Apache-2.0
// A random scene: a skeleton that gives it sense (a body, its mass, an elasticity, an integrator,
// supports, loads, tools, contact, cuts, criteria), filled with components and attributes that the
// catalogue knows. What is new there is in the scenes, too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/random_scenes/mending.h"

namespace stroma::fuzz {

// What is done to the scene before a step is made.
struct Action {
  enum class Kind { set, reset, save, restore };
  Kind kind = Kind::set;
  int step = 0;
  std::string path, value;  // of an attribute that is set
};

struct RandomScene {
  std::string text;  // XML; comments name the actions
  int steps = 10;
  std::vector<Action> actions;  // by step
  std::string manner, elasticity, integrator;
};

// The same seed and components give the same scene. `before` is told what is about to be loaded on
// the way: a crash then has its scene.
[[nodiscard]] RandomScene randomScene(const Catalogue& catalogue, const TrialFolders& folders,
                                      std::uint64_t seed, const Mending::LookAt& before);

}  // namespace stroma::fuzz
