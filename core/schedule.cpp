// SPDX-License-Identifier: Apache-2.0
#include "core/schedule.h"

#include <algorithm>

namespace stroma {

std::string_view stageName(Stage stage) {
  constexpr std::array<std::string_view, stageCount> names = {
      "input", "topology", "predict", "collide", "solve", "map", "guard", "publish"};
  return names[static_cast<std::size_t>(stage)];
}

void Schedule::run(Stage stage, const StepContext& context, bool visual, int hapticTicks,
                   Profiler& profiler) const {
  using Clock = std::chrono::steady_clock;
  const auto& entries = entries_[static_cast<std::size_t>(stage)];
  if (entries.empty()) return;
  const bool each = profiler.enabled();
  auto& rows = profiler.rows(static_cast<int>(stage));
  const auto begin = Clock::now();
  auto last = begin;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const int times = entry.rate == Rate::step     ? 1
                      : entry.rate == Rate::visual ? (visual ? 1 : 0)
                                                   : hapticTicks;
    for (int t = 0; t < times; ++t) entry.call(*entry.component, context);
    if (each && times > 0) {
      const auto now = Clock::now();
      rows[i].timer.add(now - last);
      last = now;
    }
  }
  profiler.stage(static_cast<int>(stage)).add(Clock::now() - begin);
}

std::string Schedule::text() const {
  struct Line {
    std::string stage, path, type, label, rate;
  };
  std::vector<Line> lines = {{"stage", "component", "type", "call", "rate"}};
  for (int s = 0; s < stageCount; ++s) {
    for (const Entry& e : entries_[static_cast<std::size_t>(s)]) {
      const char* rate = e.rate == Rate::step     ? "every step"
                         : e.rate == Rate::visual ? "visual rate"
                                                  : "haptic rate";
      lines.push_back({std::string(stageName(static_cast<Stage>(s))), e.component->path(),
                       e.component->type(), std::string(e.label), rate});
    }
  }
  const auto width = [&](auto member) {
    std::size_t w = 0;
    for (const Line& line : lines) w = std::max(w, (line.*member).size());
    return w + 2;
  };
  const std::size_t stageWidth = width(&Line::stage), path = width(&Line::path),
                    type = width(&Line::type), label = width(&Line::label);
  const auto padded = [](const std::string& text, std::size_t to) {
    return text + std::string(to - text.size(), ' ');
  };
  std::string text;
  for (const Line& line : lines) {
    text += padded(line.stage, stageWidth) + padded(line.path, path) + padded(line.type, type) +
            padded(line.label, label) + line.rate + "\n";
  }
  return text;
}

}  // namespace stroma
