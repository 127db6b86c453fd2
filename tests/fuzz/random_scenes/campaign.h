// SPDX-License-Identifier: Apache-2.0
// Many random scenes, each in a process of its own with bounds on its CPU time and memory.
#pragma once

#include <functional>

#include "tests/fuzz/random_scenes/trial.h"

namespace stroma::fuzz {

struct CampaignPlan {
  std::uint64_t firstSeed = 1;
  int count = 100;
  int jobs = 1;
  double timeLimit = 60;  // s of CPU time of a scene, above which it counts as hanging
  double stepTime = 0.3;  // s of CPU time for its steps
  std::size_t memory = std::size_t{2} << 30;  // bytes
  std::filesystem::path out;                  // what failed is kept here
  std::vector<std::filesystem::path> files;   // scenes to run instead of random ones, one a seed
  TrialFolders folders;
};

struct SceneResult {
  std::uint64_t seed = 0;
  Outcome outcome;
  std::string elasticity, integrator;
  double cpuSeconds = 0;
};

// Where a scene is written before it is loaded; those that end as they may are removed again.
[[nodiscard]] std::filesystem::path keptScene(const CampaignPlan& plan, std::uint64_t seed);

// Makes and runs one scene in this process, within the plan's bounds (a hang ends by SIGXCPU).
[[nodiscard]] Outcome runBounded(const Catalogue& catalogue, const CampaignPlan& plan,
                                 std::uint64_t seed, RandomScene& scene);

// Calls `done` for every scene as it ends.
void runCampaign(const Catalogue& catalogue, const CampaignPlan& plan,
                 const std::function<void(const SceneResult&)>& done);

}  // namespace stroma::fuzz
