// SPDX-License-Identifier: Apache-2.0
#include "core/finite_guard.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/interfaces/integrator.h"
#include "core/parallel.h"

namespace stroma {
namespace {

constexpr Index mostKept = 200'000;

// 0 * a is 0 for finite numbers and NaN otherwise: a sum that vectorises and needs no branch.
bool allFinite(ConstVec3Span a) {
  const double sum = parallelSum(static_cast<Index>(a.size()), 0.0, [&](Index begin, Index end) {
    const auto part =
        flat(a.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
    return (part.array() * 0.0).sum();
  });
  return sum == 0.0;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

FiniteGuard::FiniteGuard(System& system) : system_(&system), keeps_(system.size() <= mostKept) {
  if (keeps_) {
    x_.resize(static_cast<std::size_t>(system.size()));
    v_.resize(static_cast<std::size_t>(system.size()));
  }
  accept();
}

void FiniteGuard::accept() {
  if (!keeps_) return;
  flat(Vec3Span(x_)) = flat(system_->x());
  flat(Vec3Span(v_)) = flat(system_->v());
}

bool FiniteGuard::restoreLastGood() {
  if (!keeps_) return false;
  std::ranges::copy(x_, system_->x().begin());
  std::ranges::copy(v_, system_->v().begin());
  std::ranges::fill(system_->f(), Vec3::Zero());  // those of the failed step mean nothing
  system_->updateMapped();
  return true;
}

std::optional<Divergence> FiniteGuard::check(std::uint64_t step, double time, double dt) {
  if (!allFinite(system_->x()) || !allFinite(system_->v())) return explain(step, time, dt);
  return std::nullopt;
}

std::optional<Divergence> FiniteGuard::explain(std::uint64_t step, double time, double dt) {
  Divergence d;
  d.step = step;
  d.time = time;
  std::size_t bad = 0;
  while (bad < static_cast<std::size_t>(system_->size()) && system_->x()[bad].allFinite() &&
         system_->v()[bad].allFinite()) {
    ++bad;
  }
  const bool position = !system_->x()[bad].allFinite();
  d.particle = system_->particleName(static_cast<Index>(bad));
  d.component = system_->integrator().path();

  std::string cause;
  if (keeps_) {
    // every force field again, alone, at the last good state: the first that is not finite is to
    // blame
    double largest = -1;
    std::string strongest;
    for (MechanicalState* state : system_->states()) {
      const auto offset = static_cast<std::size_t>(system_->offsetOf(*state));
      const auto count = static_cast<std::size_t>(state->size());
      const StateView at{ConstVec3Span(x_).subspan(offset, count),
                         ConstVec3Span(v_).subspan(offset, count), time - dt};
      for (ForceField* force : system_->forceFields()) {
        if (&force->state() != state) continue;
        std::vector<Vec3> f(count, Vec3::Zero());
        force->addForce(at, f);
        if (!allFinite(f)) {
          d.component = force->path();
          cause = "the force of " + force->describe() + " is not finite at the last good state";
        }
        double most = 0;
        for (const Vec3& value : f) most = std::max(most, value.norm());
        if (most > largest) largest = most, strongest = force->describe();
        if (!cause.empty()) break;
      }
      if (!cause.empty()) break;
    }
    if (cause.empty() && largest >= 0) {
      cause = system_->integrator().describe() + " diverged with a step of " + number(dt) +
              " s; the largest force before it was " + number(largest) + " N, from " + strongest +
              ". Try a smaller dt or softer material";
    }
  }
  d.message = d.particle + ": the " + (position ? "position" : "velocity") +
              " is not finite after step " + std::to_string(step) + " (t = " + number(time) + " s)";
  if (!cause.empty()) d.message += "; " + cause;
  return d;
}

}  // namespace stroma
