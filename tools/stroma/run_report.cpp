// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/run_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "core/interfaces/topology_modifier.h"
#include "core/json.h"
#include "core/parallel.h"
#include "core/traverse.h"

namespace stroma::cli {
namespace {

std::string hex(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

// "  name  value" lines with the values below each other.
std::string table(const std::string& title,
                  const std::vector<std::pair<std::string, std::string>>& rows) {
  if (rows.empty()) return "";
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row.first.size());
  std::string text = title + "\n";
  for (const auto& [name, value] : rows) {
    text += "  " + name + std::string(width - name.size() + 2, ' ') + value + "\n";
  }
  return text;
}

}  // namespace

void RunReport::collectFrom(Scene& from) {
  particles = from.particleCount();
  lastStep = from.stepCount();
  dt = from.dt();
  time = from.time();
  threads = threadCount();
  modules = from.modules().loaded();
  stateHash = hex(from.stateHash());
  divergence = from.divergence();
  for (int s = 0; s < stageCount; ++s) {
    const Timer& timer = from.profiler().stage(s);
    if (timer.count() == 0) continue;
    stages.emplace_back(stageName(static_cast<Stage>(s)), perStep(timer.totalMs()));
  }
  std::set<std::string> taken;
  forEachComponent(from.root(), [&](Component& component) {
    for (const Limiter* limiter : component.limiters()) {
      if (limiter->count() == 0) continue;
      limiters.emplace_back(component.path() + "." + std::string(limiter->name()),
                            limiter->count());
    }
    const auto* observer = dynamic_cast<const Observer*>(&component);
    if (!observer) return;
    auto& values = dynamic_cast<const TopologyModifier*>(&component) ? cuts : monitors;
    for (const auto& [name, value] : observer->lastValues()) {
      // two observers may use the same name
      const bool isFree = taken.insert(name).second;
      values.emplace_back(isFree ? name : component.path() + "." + name, value);
    }
    for (CheckResult& check : observer->checks()) {
      checks.emplace_back(component.path(), std::move(check));
    }
    for (const auto& file : observer->files()) files.push_back(file.string());
  });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  peakMemoryMb = static_cast<double>(usage.ru_maxrss) / 1024;
}

bool RunReport::passed() const {
  return std::ranges::all_of(checks, [](const auto& check) { return check.second.passed; });
}

double RunReport::perStep(double ms) const {
  return steps > 0 ? ms / static_cast<double>(steps) : 0;
}

double RunReport::realTimeFactor() const {
  return wallMs > 0 ? 1000 * dt * static_cast<double>(steps) / wallMs : 0;
}

std::string RunReport::text() const {
  std::string text = scene + ": " + std::to_string(particles) + " particles, " +
                     std::to_string(steps) + " steps of " + rounded(dt) + " s to " + rounded(time) +
                     " s" + (interrupted ? ", interrupted" : "") + "\n";
  text += "loaded in " + rounded(loadMs) + " ms; " + rounded(perStep(wallMs)) + " ms per step (" +
          rounded(perStep(cpuMs)) + " ms CPU) on " + std::to_string(threads) +
          (threads == 1 ? " thread" : " threads") + ", " + rounded(realTimeFactor()) +
          " times real time\n";
  std::vector<std::pair<std::string, std::string>> rows;
  for (const auto& [name, value] : monitors) rows.emplace_back(name, rounded(value));
  text += table("monitors, last values (SI units)", rows);
  rows.clear();
  for (const auto& [name, value] : cuts) rows.emplace_back(name, rounded(value));
  text += table("what was cut (SI units)", rows);
  rows.clear();
  for (const auto& [name, count] : limiters) rows.emplace_back(name, std::to_string(count));
  text += table("limiters that acted, and how often", rows);
  rows.clear();
  for (const auto& [path, check] : checks) {
    rows.emplace_back(path + "." + check.criterion,
                      (check.passed ? "passed  " : "FAILED  ") + check.message);
  }
  text += table("criteria, at worst", rows);
  if (!files.empty()) text += "files written\n";
  for (const std::string& file : files) text += "  " + file + "\n";
  return text;
}

std::string RunReport::json() const {
  JsonWriter json;
  const auto object = [&](const char* name, const auto& members) {
    json.key(name).beginObject();
    for (const auto& [key, value] : members) json.member(key, value);
    json.endObject();
  };
  const auto array = [&](const char* name, const auto& items) {
    json.key(name).beginArray();
    for (const auto& item : items) json.value(item);
    json.endArray();
  };
  json.beginObject();
  json.member("scene", scene).member("particles", particles).member("steps", steps);
  json.member("last_step", lastStep).member("dt", dt).member("time", time);
  json.member("threads", threads);
  json.member("wall_ms_per_step", perStep(wallMs)).member("cpu_ms_per_step", perStep(cpuMs));
  object("stages", stages);
  json.member("real_time_factor", realTimeFactor()).member("load_ms", loadMs);
  json.member("peak_memory_mb", peakMemoryMb);
  array("modules", modules);
  object("limiters", limiters);
  json.member("state_hash", stateHash);
  object("monitors", monitors);
  for (const auto& [name, value] : cuts) json.member(name, value);
  if (!checks.empty()) {
    json.key("checks").beginArray();
    for (const auto& [path, check] : checks) {
      json.beginObject().member("component", path).member("criterion", check.criterion);
      json.member("passed", check.passed).member("measured", check.measured);
      json.member("bound", check.bound).member("step", check.step);
      json.endObject();
    }
    json.endArray();
  }
  array("files", files);
  if (interrupted) json.member("interrupted", true);
  if (divergence) {
    json.key("diverged").beginObject();
    json.member("component", divergence->component).member("particle", divergence->particle);
    json.member("step", divergence->step).member("time", divergence->time);
    json.member("message", divergence->message);
    json.endObject();
  }
  json.endObject();
  return json.text() + "\n";
}

}  // namespace stroma::cli
