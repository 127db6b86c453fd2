// SPDX-License-Identifier: Apache-2.0
// The schedule: the flat list of calls that one step makes, compiled once from the scene. A
// component that adds no call costs nothing in a step.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/component.h"
#include "core/profiler.h"

namespace stroma {

// In the order in which they run.
enum class Stage { Input, Topology, Predict, Collide, Solve, Map, Guard, Publish };
inline constexpr int stageCount = 8;
[[nodiscard]] std::string_view stageName(Stage stage);

// How often a call is made.
enum class Rate { step, visual, haptic };

struct StepContext {
  double time;         // s, at the beginning of the step; after Stage::Solve, at its end
  double dt;           // s
  std::uint64_t step;  // number of the step that is being made, from 1
};

class Schedule {
 public:
  using Call = void (*)(Component&, const StepContext&);
  struct Entry {
    Component* component;
    Call call;
    std::string_view label;
    Rate rate;
  };

  // Adds component.Method(context) to a stage. Within a stage calls run in document order.
  template <auto Method, class C>
  void add(Stage stage, C& component, std::string_view label, Rate rate = Rate::step) {
    entries_[static_cast<std::size_t>(stage)].push_back(
        {&component,
         [](Component& c, const StepContext& context) { (static_cast<C&>(c).*Method)(context); },
         label, rate});
  }

  [[nodiscard]] const std::vector<Entry>& stage(Stage stage) const {
    return entries_[static_cast<std::size_t>(stage)];
  }

  // Runs one stage. `visual` and `hapticTicks` say which of the slower and faster calls are due.
  void run(Stage stage, const StepContext& context, bool visual, int hapticTicks,
           Profiler& profiler) const;

  // One line a call: stage, component, what it does, rate.
  [[nodiscard]] std::string text() const;

 private:
  std::array<std::vector<Entry>, stageCount> entries_;
};

}  // namespace stroma
