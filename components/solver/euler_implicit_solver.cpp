// SPDX-License-Identifier: Apache-2.0
#include "components/solver/euler_implicit_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/solver/conjugate_gradient.h"
#include "components/solver/start_checks.h"
#include "core/parallel.h"
#include "core/snapshot.h"

namespace stroma {

void EulerImplicitSolver::configure() {
  if (trapezoidalScheme && newtonIterations > 1) {
    error(trapezoidalScheme, "attr-conflict", "works with newtonIterations=\"1\" only");
  }
}

void EulerImplicitSolver::start() {
  System& s = system();
  requireMasses(*this, s);
  const auto n = static_cast<std::size_t>(s.size());
  b_.resize(n);
  dv_.assign(n, Vec3::Zero());
  for (auto* a : {&x0_, &v0_}) a->resize(n);
  if (newtonIterations > 1) {
    for (auto* a : {&moved_, &damping_}) a->resize(n);
  }
  spacing_ = typicalDistance(s.rest());
  s.project(s.v());
}

void EulerImplicitSolver::reset() {
  std::ranges::fill(dv_, Vec3::Zero());
  system().project(system().v());
}

void EulerImplicitSolver::save(StateWriter& writer) const {
  writer.write("lastSolution", ConstVec3Span(dv_));
}

void EulerImplicitSolver::restore(StateReader& reader) {
  if (!reader.read("lastSolution", Vec3Span(dv_))) std::ranges::fill(dv_, Vec3::Zero());
}

void EulerImplicitSolver::integrate(const StepContext& step) {
  h_ = step.dt;
  time_ = step.time + step.dt;
  std::ranges::copy(system().x(), x0_.begin());
  std::ranges::copy(system().v(), v0_.begin());
  if (newtonIterations == 1) {
    linearStep(step);
  } else {
    newtonStep();
  }
  keepEnergy();
  if (vdamping > 0) flat(system().v()) *= std::exp(-step.dt * vdamping);
}

void EulerImplicitSolver::linearStep(const StepContext& step) {
  System& s = system();
  const Vec3Span x = s.x(), v = s.v(), f = s.f();
  const double h = step.dt, part = trapezoidalScheme ? 0.5 : 1.0;
  s.computeForce({x, v, step.time + part * h}, f);
  s.linearize({x, v, step.time + part * h});

  const auto mass = s.mass();
  const double massDamping = h * rayleighMass, stiffness = h * (part * h + rayleighStiffness);
  parallelFor(s.size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    b_[i] = h * f[i] - (massDamping * mass[i]) * v[i];
  });
  s.addTangentProduct(v, stiffness, 0, b_);
  s.project(b_);
  const SystemMatrix matrix{s, 1 + part * massDamping, part * h, part * stiffness};
  const LinearSolution solution = linearSolver->solve(matrix, b_, dv_);
  parallelFor(s.size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    x[i] += h * (v[i] + part * dv_[i]);
    v[i] += dv_[i];
  });
  lastNewtonIterations.set(1);
  lastLinearIterations.set(solution.iterations);
  lastResidual.set(solution.residual);
}

void EulerImplicitSolver::newtonStep() {
  System& s = system();
  lastLinearIterations.set(0);
  // forces that depend on velocities show in the derivative; without any, D costs nothing
  s.linearize({x0_, v0_, time_});
  std::ranges::fill(damping_, Vec3::Zero());
  s.addTangentProduct(v0_, 0, 1, damping_);
  damps_ = rayleighMass > 0 || rayleighStiffness > 0 || dot(damping_, damping_) > 0;

  // from rest: the energy at the start is then the one that the last step ended with
  std::ranges::fill(s.v(), Vec3::Zero());
  const double start = newton_.residualAt(*this, s.v());
  const NewtonResult result = newton_.minimise(*this, s.v(), {newtonIterations, tolerance * start});
  if (!result.converged) ++notConverged_;
  lineSearchFailed_.add(static_cast<std::uint64_t>(result.lineSearchFailures));
  moveTo(s.v());
  std::ranges::copy(moved_, s.x().begin());
  lastNewtonIterations.set(result.iterations);
  lastResidual.set(start > 0 ? result.residual / start : 0);
}

// With the trapezoidal rule velocities and moves differ; it is for accuracy, and left alone.
void EulerImplicitSolver::keepEnergy() {
  if (trapezoidalScheme) return;
  const double bound = carefulMove * spacing_;
  const bool careful = std::ranges::any_of(
      system().v(), [&](const Vec3& v) { return !(h_ * h_ * v.squaredNorm() <= bound * bound); });
  if (careful) shorten();
}

void EulerImplicitSolver::shorten() {
  System& s = system();
  const double before = s.kineticEnergy(v0_) + s.potentialEnergy({x0_, v0_, time_});
  // what rounding may add
  const double most = before + 1e-12 * std::abs(before);
  double part = 1;
  if (energyWith(part) <= most) return;
  ++shortened_;
  full_.assign(s.v().begin(), s.v().end());
  base_ = Vec3::Zero();
  if (s.projectors().empty()) {
    double mass = 0;
    for (std::size_t i = 0; i < v0_.size(); ++i) {
      base_ += s.mass()[i] * v0_[i];
      mass += s.mass()[i];
    }
    base_ /= mass;
  }
  constexpr int mostTrials = 40;
  for (int k = 0; k < mostTrials; ++k) {
    part = k + 1 < mostTrials ? part / 2 : 0;
    const double now = energyWith(part);
    if (now <= most) return;
  }
}

// The energy of the step when only this part of the velocities over the base is taken; the state is
// left there.
double EulerImplicitSolver::energyWith(double part) {
  System& s = system();
  const Vec3Span x = s.x(), v = s.v();
  if (part < 1) {
    parallelFor(s.size(), [&](Index k) {
      const auto i = static_cast<std::size_t>(k);
      v[i] = base_ + part * (full_[i] - base_);
      x[i] = x0_[i] + h_ * v[i];
    });
  }
  const double energy = s.kineticEnergy(v) + s.potentialEnergy({x, v, time_});
  return std::isfinite(energy) ? energy : std::numeric_limits<double>::infinity();
}

void EulerImplicitSolver::moveTo(ConstVec3Span v) {
  parallelFor(system().size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    moved_[i] = x0_[i] + h_ * v[i];
  });
}

// damping_ = D v, with the derivatives at the beginning of the step.
void EulerImplicitSolver::dampingForce(ConstVec3Span v) {
  System& s = system();
  const auto mass = s.mass();
  parallelFor(s.size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    damping_[i] = (rayleighMass * mass[i]) * v[i];
  });
  s.linearize({x0_, v0_, time_});
  s.addTangentProduct(v, -rayleighStiffness, -1, damping_);
}

double EulerImplicitSolver::energy(ConstVec3Span v) {
  System& s = system();
  moveTo(v);
  double sum = s.potentialEnergy({moved_, v, time_});
  const auto mass = s.mass();
  sum += parallelSum(s.size(), 0.0, [&](Index begin, Index end) {
    double kinetic = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      kinetic += 0.5 * mass[i] * (v[i] - v0_[i]).squaredNorm();
    }
    return kinetic;
  });
  if (damps_) {
    dampingForce(v);
    sum += 0.5 * h_ * dot(v, damping_);
  }
  return sum;
}

// Gradient by v of the incremental potential, negative: h f(x_n + h v, v) - M (v - v_n) - h (rM M -
// rK K) v.
void EulerImplicitSolver::residual(ConstVec3Span v, Vec3Span r) {
  System& s = system();
  moveTo(v);
  s.computeForce({moved_, v, time_}, s.f());
  const Vec3Span f = s.f();
  const auto mass = s.mass();
  const double massDamping = h_ * rayleighMass;
  parallelFor(s.size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    r[i] = h_ * f[i] - mass[i] * (v[i] - v0_[i]) - (massDamping * mass[i]) * v[i];
  });
  if (rayleighStiffness > 0) {
    s.linearize({x0_, v0_, time_});
    s.addTangentProduct(v, h_ * rayleighStiffness, 0, r);
  }
  s.project(r);
}

void EulerImplicitSolver::direction(ConstVec3Span v, ConstVec3Span r, Vec3Span d) {
  System& s = system();
  moveTo(v);
  s.linearize({moved_, v, time_});
  const SystemMatrix matrix{s, 1 + h_ * rayleighMass, h_, h_ * (h_ + rayleighStiffness)};
  const LinearSolution solution = linearSolver->solve(matrix, r, d);
  lastLinearIterations.set(lastLinearIterations + solution.iterations);
}

double EulerImplicitSolver::rounding(ConstVec3Span) const {
  return 2 * std::numeric_limits<double>::epsilon() *
         flat(ConstVec3Span(x0_)).cwiseAbs().maxCoeff() / h_;
}

}  // namespace stroma
