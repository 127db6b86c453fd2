// SPDX-License-Identifier: Apache-2.0
#include "core/profiler.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace stroma {
namespace {

constexpr double binRatio = 1.04;

std::size_t binOf(std::uint64_t ns) {
  return ns < 2 ? 0
                : static_cast<std::size_t>(std::log(static_cast<double>(ns)) / std::log(binRatio));
}

}  // namespace

void Timer::add(std::chrono::nanoseconds duration) {
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(0, duration.count()));
  ++count_;
  total_ += ns;
  max_ = std::max(max_, ns);
  const std::size_t bin = binOf(ns);
  if (bin >= bins_.size()) bins_.resize(bin + 1);
  ++bins_[bin];
}

double Timer::percentileMs(double fraction) const {
  const double wanted = fraction * static_cast<double>(count_);
  double seen = 0;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    seen += bins_[b];
    if (seen >= wanted) {
      return std::min(std::pow(binRatio, static_cast<double>(b) + 0.5) * 1e-6, maxMs());
    }
  }
  return maxMs();
}

std::string Profiler::text() const {
  char line[256];
  std::string text;
  std::snprintf(line, sizeof line, "%-9s %-34s %-14s %9s %9s %9s %9s %9s\n", "stage", "component",
                "call", "calls", "mean ms", "p50 ms", "p99 ms", "max ms");
  text += line;
  const auto add = [&](const std::string& stage, const std::string& component,
                       const std::string& label, const Timer& t) {
    std::snprintf(line, sizeof line, "%-9s %-34s %-14s %9llu %9.4f %9.4f %9.4f %9.4f\n",
                  stage.c_str(), component.c_str(), label.c_str(),
                  static_cast<unsigned long long>(t.count()), t.meanMs(), t.percentileMs(0.5),
                  t.percentileMs(0.99), t.maxMs());
    text += line;
  };
  for (const auto& rows : rows_) {
    for (const Row& row : rows) add(row.stage, row.component, row.label, row.timer);
  }
  add("step", "", "", step_);
  return text;
}

}  // namespace stroma
