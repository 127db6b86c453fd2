// SPDX-License-Identifier: Apache-2.0
// What a run did, as text for people and as JSON for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/interfaces/observer.h"
#include "core/scene.h"

namespace stroma::cli {

struct RunReport {
  std::string scene;
  Index particles = 0;
  std::uint64_t steps = 0;     // made by this run
  std::uint64_t lastStep = 0;  // counted from the start of the scene
  double dt = 0, time = 0;     // s, simulated
  int threads = 1;
  double wallMs = 0, cpuMs = 0, loadMs = 0;  // of all steps; of loading and initialising
  double peakMemoryMb = 0;
  std::vector<std::pair<std::string, double>> stages;  // ms per step
  std::vector<std::string> modules;
  std::vector<std::pair<std::string, std::uint64_t>> limiters;  // those that acted
  std::vector<std::pair<std::string, double>> monitors;         // last values
  std::vector<std::pair<std::string, double>>
      cuts;  // pieces, incision_length, ...: members of their own
  std::vector<std::pair<std::string, CheckResult>> checks;  // with the component's path
  std::vector<std::string> files;                           // written
  std::string stateHash;
  std::optional<Divergence> divergence;
  bool interrupted = false;

  // Takes over what the scene knows after its last step.
  void collectFrom(Scene& from);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string json() const;
  // Whether all criteria are met.
  [[nodiscard]] bool passed() const;

 private:
  [[nodiscard]] double perStep(double ms) const;
  // Simulated time over wall time.
  [[nodiscard]] double realTimeFactor() const;
};

}  // namespace stroma::cli
