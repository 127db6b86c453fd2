// SPDX-License-Identifier: Apache-2.0
// What a campaign has found: counts, limiters, failures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/random_scenes/campaign.h"

namespace stroma::fuzz {

class Summary {
 public:
  void add(const SceneResult& result);
  [[nodiscard]] int failed() const { return total_.of[static_cast<std::size_t>(Ending::failed)]; }
  [[nodiscard]] int scenes() const { return total_.all(); }
  // Tables by elasticity and integrator, limiters, CPU times, and the last line with the counts.
  [[nodiscard]] std::string text() const;

 private:
  struct Counts {
    std::array<int, 4> of{};
    long steps = 0;
    [[nodiscard]] int all() const { return of[0] + of[1] + of[2] + of[3]; }
  };
  [[nodiscard]] static std::string table(const std::string& title,
                                         const std::map<std::string, Counts>& rows);
  static void count(Counts& counts, const Outcome& outcome);

  Counts total_;
  std::map<std::string, Counts> byElasticity_, byIntegrator_;
  std::map<std::string, std::pair<int, std::uint64_t>> limiters_;  // scenes, times
  std::map<std::string, int> diagnostics_;
  int cut_ = 0;  // scenes
  long cuts_ = 0;
  double cpu_ = 0, slowest_ = 0;
  std::uint64_t slowestSeed_ = 0;
};

}  // namespace stroma::fuzz
