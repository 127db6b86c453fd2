// SPDX-License-Identifier: Apache-2.0
#include "components/solver/euler_explicit_solver.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "components/solver/start_checks.h"
#include "core/parallel.h"
#include "core/scene.h"

namespace stroma {
namespace {

// Estimates approach the eigenvalue from below, and tissue stiffens between them.
constexpr double safety = 0.9;
// Products that the first estimate may take, one that only serves a warning, and one that goes on
// from the mode found before.
constexpr int iterationsAtStart = 100, iterationsToWarn = 20, iterationsToFollow = 8;
// Relative change of the stable step between estimates that brings the next one nearer, or puts it
// off.
constexpr double quickChange = 0.02, slowChange = 0.01;

// h^2 times the eigenvalue is 3.24 with a perfect estimate, and 4 at the limit of stability.
constexpr double tooStiff = 3.8;
constexpr int mostRepeats = 8;
// Sub-steps that move a particle by more than this part of the particles' distance are long; then
// a step may gain this part of the energy that it turns over, which symplectic Euler does anyway.
constexpr double longMove = 0.05, mostGain = 0.05;

std::string rounded(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 2).ptr};
}

}  // namespace

void EulerExplicitSolver::start() {
  System& s = system();
  requireMasses(*this, s);
  if (failed()) return;
  heldForce_.resize(s.projectors().size());
  last_.resize(static_cast<std::size_t>(s.size()));
  spacing_ = typicalDistance(s.rest());
  s.project(s.v());
  const double dt = scene().dt();
  estimate(scene().time(), dt, iterationsAtStart);
  if (substeps > 0 && dt / substeps > stableStep) {
    warning("substeps-unstable",
            "sub-steps of " + ValueTraits<double>::print(dt / substeps) +
                " s are longer than the largest stable one, about " + rounded(stableStep) + " s",
            "leave 'substeps' out, or give at least " +
                std::to_string(static_cast<int>(std::ceil(dt / (safety * stableStep)))));
  }
}

void EulerExplicitSolver::reset() {
  stability_.forget();
  changed_ = cut_ = false;
  interval_ = 1;
  needed_ = 0;
  nextEstimate_ = 2;
  substepChanges.set(0);
  system().project(system().v());
  estimate(scene().time(), scene().dt(), iterationsAtStart);
}

void EulerExplicitSolver::estimate(double time, double dt, int iterations) {
  System& s = system();
  s.linearize({s.x(), s.v(), time});
  stability_.update(s, rayleighMass, rayleighStiffness,
                    substeps > 0 ? iterationsToWarn : iterations);
  stableStep.set(std::min(stability_.largestStep(), 1e30));
  if (substeps > 0) {
    currentSubsteps.set(substeps);
    return;
  }
  const double wanted = std::max(1.0, std::ceil(dt / (safety * stableStep)));
  if (wanted > maxSubsteps) ++capped_;
  currentSubsteps.set(static_cast<int>(std::min<double>(wanted, maxSubsteps)));
}

// While tissue stiffens or softens quickly estimates follow each other closely.
void EulerExplicitSolver::reestimate(const StepContext& step) {
  const int substepsBefore = currentSubsteps;
  const double before = stableStep;
  if (cut_) stability_.disturb(system());
  estimate(step.time, step.dt, changed_ ? iterationsAtStart : iterationsToFollow);
  // what a repeated step has needed is given up by and by
  currentSubsteps.set(std::max<int>(currentSubsteps, needed_));
  needed_ -= (needed_ + 9) / 10;
  // a mode that the cut has made needs some estimates to come out
  if (cut_) interval_ = 1;
  changed_ = cut_ = false;
  if (currentSubsteps != substepsBefore) substepChanges.set(substepChanges + 1);
  const double change = std::abs(stableStep - before) / before;
  if (change > quickChange)
    interval_ = std::max(1, interval_ / 2);
  else if (change < slowChange)
    interval_ *= 2;
  interval_ = std::min<int>(interval_, estimateEvery);
  nextEstimate_ = step.step + static_cast<std::uint64_t>(interval_);
}

void EulerExplicitSolver::integrate(const StepContext& step) {
  if (changed_ || (substeps == 0 && (cut_ || step.step >= nextEstimate_))) reestimate(step);
  if (substeps > 0) {
    (void)makeSubsteps(step, false);
    return;
  }
  System& s = system();
  startX_.assign(s.x().begin(), s.x().end());
  startV_.assign(s.v().begin(), s.v().end());
  bool trusts = false;  // what looked like stiffness was not
  for (int repeat = 0;; ++repeat) {
    const bool whole = makeSubsteps(step, !trusts && repeat < mostRepeats);
    if (whole && (repeat >= mostRepeats || !hasGained(step))) {
      if (repeat > 0) needed_ = currentSubsteps;
      return;
    }
    if (whole) {
      currentSubsteps.set(std::min<int>(2 * currentSubsteps, maxSubsteps));
    } else if (!needsMoreSubsteps(step)) {
      trusts = true;  // a load has set in
    }
    if (whole || !trusts) {
      ++repeated_;
      substepChanges.set(substepChanges + 1);
      interval_ = 1;
      nextEstimate_ = step.step + 1;
    }
    std::ranges::copy(startX_, s.x().begin());
    std::ranges::copy(startV_, s.v().begin());
  }
}

// Whether a step whose sub-steps were long has gained more energy than rounding off the true motion
// explains; what loads that move have done is in the energy before.
bool EulerExplicitSolver::hasGained(const StepContext& step) {
  System& s = system();
  const double h = step.dt / currentSubsteps, bound = longMove * spacing_;
  const bool isLong = std::ranges::any_of(
      s.v(), [&](const Vec3& v) { return !(h * h * v.squaredNorm() <= bound * bound); });
  if (!isLong || currentSubsteps >= maxSubsteps) return false;
  const double time = step.time + step.dt, kinetic = s.kineticEnergy(s.v());
  const double before = s.potentialEnergy({startX_, startV_, time}),
               after = s.potentialEnergy({s.x(), s.v(), time});
  const double gained = after - before + kinetic - s.kineticEnergy(startV_);
  return !(gained <= mostGain * std::max(kinetic, std::abs(after - before)));
}

// False as soon as the tissue turns out too stiff for the sub-step, where that is watched.
bool EulerExplicitSolver::makeSubsteps(const StepContext& step, bool watched) {
  const double h = step.dt / currentSubsteps;
  lastSpeed_ = 0;
  for (int k = 0; k < currentSubsteps; ++k) {
    substep(step.time + k * h, h, watched);
    if (watched && tooStiff_) return false;
  }
  return true;
}

void EulerExplicitSolver::substep(double time, double h, bool watched) {
  System& s = system();
  const Vec3Span x = s.x(), v = s.v(), f = s.f();
  s.computeForce({x, v, time}, f);
  if (rayleighStiffness > 0) {
    s.linearize({x, v, time});
    s.addTangentProduct(v, rayleighStiffness, 0, f);
  }
  const auto& held = s.projectors();
  for (std::size_t k = 0; k < held.size(); ++k) {
    Vec3& own = f[static_cast<std::size_t>(held[k].particle)];
    heldForce_[k] = own;
    own = held[k].projector * own;
  }
  const double* inverseMass = s.inverseMass().data();
  const double keep = 1 - h * rayleighMass;
  const auto update = [&](auto move) {
    parallelFor(s.size(), [&](Index n) {
      const auto i = static_cast<std::size_t>(n);
      const Vec3 next = keep * v[i] + (h * inverseMass[i]) * f[i];
      x[i] += h * move(v[i], next);
      v[i] = next;
    });
  };
  if (symplectic) {
    update([](const Vec3&, const Vec3& next) -> const Vec3& { return next; });
  } else {
    update([](const Vec3& last, const Vec3&) -> const Vec3& { return last; });
  }
  if (watched) watch(h);
  for (std::size_t k = 0; k < held.size(); ++k) {
    f[static_cast<std::size_t>(held[k].particle)] = heldForce_[k];
  }
}

// Looks at how much the accelerations have changed over the way of the sub-step before; f is
// projected, v already the velocity of this one.
void EulerExplicitSolver::watch(double h) {
  System& s = system();
  const Vec3Span v = s.v(), f = s.f();
  const double *mass = s.mass().data(), *inverseMass = s.inverseMass().data();
  const Eigen::Vector2d sums =
      parallelSum(s.size(), Eigen::Vector2d(0, 0), [&](Index begin, Index end) {
        double change = 0, speed = 0;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          const Vec3 acceleration = inverseMass[i] * f[i];
          change += mass[i] * (acceleration - last_[i]).squaredNorm();
          speed += mass[i] * v[i].squaredNorm();
          last_[i] = acceleration;
        }
        return Eigen::Vector2d(change, speed);
      });
  // h^2 |da| / |dx| against the limit of stability
  const double most = tooStiff / h;
  tooStiff_ = lastSpeed_ > 0 && !(sums[0] <= most * most * lastSpeed_);
  lastSpeed_ = sums[1];
}

// The state is where a step has shown itself too stiff.
bool EulerExplicitSolver::needsMoreSubsteps(const StepContext& step) {
  System& s = system();
  const int before = currentSubsteps;
  const bool finite = flat(s.x()).allFinite() && flat(s.v()).allFinite();
  if (finite) {
    estimate(step.time, step.dt, iterationsToWarn);
  } else {
    stability_.forget();
    currentSubsteps.set(std::min<int>(2 * before, maxSubsteps));
  }
  if (currentSubsteps > before) {
    // by and by: where the motion has gone wrong the tissue may seem stiffer than it is
    currentSubsteps.set(std::min<int>(currentSubsteps, 2 * before));
    return true;
  }
  currentSubsteps.set(before);
  return false;
}

void EulerExplicitSolver::save(StateWriter& writer) const {
  writer.write("currentSubsteps", currentSubsteps.value());
  writer.write("substepChanges", substepChanges.value());
  writer.write("stableStep", stableStep.value());
  writer.write("changed", (changed_ ? 1 : 0) | (cut_ ? 2 : 0));
  writer.write("interval", interval_);
  writer.write("needed", needed_);
  writer.write("nextEstimate", nextEstimate_);
  stability_.save(writer);
}

void EulerExplicitSolver::restore(StateReader& reader) {
  int count = 1, changes = 0, changed = 0;
  double stable = 0;
  if (reader.read("currentSubsteps", count)) currentSubsteps.set(count);
  if (reader.read("substepChanges", changes)) substepChanges.set(changes);
  if (reader.read("stableStep", stable)) stableStep.set(stable);
  if (reader.read("changed", changed)) changed_ = (changed & 1) != 0, cut_ = (changed & 2) != 0;
  int interval = 1;
  std::uint64_t next = 2;
  if (reader.read("interval", interval)) interval_ = interval;
  int needed = 0;
  if (reader.read("needed", needed)) needed_ = needed;
  if (reader.read("nextEstimate", next)) nextEstimate_ = next;
  stability_.restore(reader);
}

}  // namespace stroma
