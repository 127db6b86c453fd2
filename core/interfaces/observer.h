// SPDX-License-Identifier: Apache-2.0
// An observer has something to say of a run: monitors, exporters, a hand's controller. The run's
// summary asks it for the values it saw last and the files it wrote.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/component.h"

namespace stroma {

// A criterion that a run has met or missed: "maxSpeed", what was measured at worst and when.
struct CheckResult {
  std::string criterion;
  bool passed = true;
  double measured = 0, bound = 0;
  std::uint64_t step = 0;  // of the worst
  std::string message;     // "7.2 m/s at step 12 (0.012 s); bound at most 5 m/s"
  SourceRange where;
};

class Observer : public Component {
 public:
  static constexpr std::string_view role = "Observer";

  // Named values as they were last seen, in SI units.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> lastValues() const {
    return {};
  }
  // Criteria of the run, for those that have any; complete after stop(). One that is missed makes
  // the run fail.
  [[nodiscard]] virtual std::vector<CheckResult> checks() const { return {}; }
  // Files written so far.
  [[nodiscard]] virtual std::vector<std::filesystem::path> files() const { return {}; }
  // Why output is missing (a full disk, ...), empty when all was written.
  [[nodiscard]] virtual std::string trouble() const { return {}; }
};

}  // namespace stroma
