// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/summary.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace stroma::fuzz {
namespace {

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  std::array<char, 300> text{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(text.data(), text.size(), format, values);
  va_end(values);
  return text.data();
}

}  // namespace

void Summary::count(Counts& counts, const Outcome& outcome) {
  ++counts.of[static_cast<std::size_t>(outcome.ending)];
  counts.steps += outcome.steps;
}

void Summary::add(const SceneResult& result) {
  count(total_, result.outcome);
  count(byElasticity_[result.elasticity.empty() ? "none, or not known" : result.elasticity],
        result.outcome);
  count(byIntegrator_[result.integrator.empty() ? "not known" : result.integrator], result.outcome);
  for (const auto& [name, times] : result.outcome.limiters) {
    auto& [scenes, all] = limiters_[name];
    ++scenes;
    all += times;
  }
  if (result.outcome.ending == Ending::diagnosed) {
    ++diagnostics_[result.outcome.story.substr(0, result.outcome.story.find(':'))];
  }
  cut_ += result.outcome.cuts > 0 ? 1 : 0;
  cuts_ += result.outcome.cuts;
  cpu_ += result.cpuSeconds;
  if (result.cpuSeconds > slowest_) slowest_ = result.cpuSeconds, slowestSeed_ = result.seed;
}

std::string Summary::table(const std::string& title, const std::map<std::string, Counts>& rows) {
  std::string text = line("%-42s %9s %9s %9s %9s %9s\n", title.c_str(), "diagnosed", "finite",
                          "stopped", "failed", "steps");
  for (const auto& [name, counts] : rows) {
    const auto& of = counts.of;  // finite, diagnosed, stopped, failed
    text += line("  %-40s %9d %9d %9d %9d %9ld\n", name.c_str(), of[1], of[0], of[2], of[3],
                 counts.steps);
  }
  return text;
}

std::string Summary::text() const {
  std::string text = table("elasticity", byElasticity_) + table("integrator", byIntegrator_);
  text += line("%-42s %9s %9s\n", "limiters that acted", "scenes", "times");
  for (const auto& [name, counts] : limiters_) {
    text += line("  %-40s %9d %9llu\n", name.c_str(), counts.first,
                 static_cast<unsigned long long>(counts.second));
  }
  std::vector<std::pair<int, std::string>> kinds;
  for (const auto& [id, times] : diagnostics_) kinds.emplace_back(-times, id);
  std::ranges::sort(kinds);
  text += "first diagnostics:";
  for (const auto& [times, id] : kinds) text += " " + id + " " + std::to_string(-times);
  const int all = std::max(1, scenes());
  text += line("\n%d scenes were cut, with %ld changes of topology", cut_, cuts_);
  text += line("\n%.0f s of CPU time, %.3f s a scene; the slowest took %.1f s (seed %llu)\n", cpu_,
               cpu_ / all, slowest_, static_cast<unsigned long long>(slowestSeed_));
  return text + line("%d scenes: %d diagnosed, %d finite, %d stopped by the guard, %d failed\n",
                     scenes(), total_.of[1], total_.of[0], total_.of[2], total_.of[3]);
}

}  // namespace stroma::fuzz
