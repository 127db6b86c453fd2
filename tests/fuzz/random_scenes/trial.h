// SPDX-License-Identifier: Apache-2.0
// One random scene, loaded and run in this process, and what has become of it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/fuzz/random_scenes/random_scene.h"

namespace stroma::fuzz {

enum class Ending { finite, diagnosed, stopped, failed };
// "finite", ...; "failed" for texts that are none of them.
[[nodiscard]] std::string_view nameOf(Ending ending);
[[nodiscard]] Ending endingOf(std::string_view name);

struct Outcome {
  Ending ending = Ending::failed;
  std::string story;  // the first diagnostic, the guard's explanation, what is wrong
  int steps = 0;      // made
  int cuts = 0;       // changes of topology
  std::vector<std::pair<std::string, std::uint64_t>> limiters;  // "Type.limiter", how often
};

// Makes the scene's steps, or as many as fit into so many seconds of CPU time. Everything is
// looked at here, whatever the scene's own guard says: all positions and velocities after every
// step, diagnostics without a text or a place, explanations that name nothing in the scene, the
// invariants of bodies that have been cut, restored states.
[[nodiscard]] Outcome runTrial(const RandomScene& scene, const TrialFolders& folders,
                               double seconds);

}  // namespace stroma::fuzz
