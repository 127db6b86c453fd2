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
  const double h = step.dt / currentSubsteps;
  for (int k = 0; k < currentSubsteps; ++k) substep(step.time + k * h, h);
}

void EulerExplicitSolver::substep(double time, double h) {
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
  for (std::size_t k = 0; k < held.size(); ++k) {
    f[static_cast<std::size_t>(held[k].particle)] = heldForce_[k];
  }
}

void EulerExplicitSolver::save(StateWriter& writer) const {
  writer.write("currentSubsteps", currentSubsteps.value());
  writer.write("substepChanges", substepChanges.value());
  writer.write("stableStep", stableStep.value());
  writer.write("changed", (changed_ ? 1 : 0) | (cut_ ? 2 : 0));
  writer.write("interval", interval_);
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
  if (reader.read("nextEstimate", next)) nextEstimate_ = next;
  stability_.restore(reader);
}

}  // namespace stroma
