// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_solver.h"

#include "core/parallel.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {

void XpbdSolver::start() {
  System& s = system();
  if (const Index massless = s.masslessParticle(); massless >= 0) {
    error("mass-zero", "needs masses, but " + s.particleName(massless) + " has none",
          "add a UniformMass or a DiagonalMass to the node of the state");
    return;
  }
  gatherConstraints();
  gatherHeld();
  start_.resize(static_cast<std::size_t>(s.size()));
  s.project(s.v());
}

void XpbdSolver::gatherConstraints() {
  int count = 0;
  for (XpbdConstraint* constraint : collect<XpbdConstraint>(scene().root())) {
    const Index offset = system().offsetOf(constraint->state());
    if (offset < 0) continue;  // another solver's, or reported by itself
    constraints_.push_back({constraint, static_cast<std::size_t>(offset),
                            static_cast<std::size_t>(constraint->state().size())});
    count += constraint->count();
  }
  constraintCount.set(count);
  if (constraints_.empty()) {
    warning("xpbd-none", "has no constraints to solve: it makes explicit steps",
            "add an XPBDTetrahedronConstraint to the node of the state");
  }
}

void XpbdSolver::gatherHeld() {
  const System& s = system();
  inverseMass_.assign(s.inverseMass().begin(), s.inverseMass().end());
  std::vector<const Mat3*> partly(inverseMass_.size(), nullptr);
  bool any = false;
  for (const ParticleProjector& p : s.projectors()) {
    const auto i = static_cast<std::size_t>(p.particle);
    if (p.projector.isZero(0)) {
      inverseMass_[i] = 0;
    } else {
      partly[i] = &p.projector;
      any = true;
    }
  }
  if (any) partlyHeld_ = std::move(partly);
}

void XpbdSolver::integrate(const StepContext& step) {
  const double h = step.dt / substeps;
  for (int k = 0; k < substeps; ++k) substep(step.time + k * h, h);
}

void XpbdSolver::substep(double time, double h) {
  System& s = system();
  s.computeForce({s.x(), s.v(), time}, s.f());
  predict(h);
  for (const Entry& entry : constraints_) entry.constraint->clearMultipliers();
  for (int k = 0; k < iterations; ++k) {
    for (const Entry& entry : constraints_) entry.constraint->project(particlesOf(entry, h));
  }
  const Vec3Span x = s.x(), v = s.v();
  parallelFor(s.size(), [&](Index n) {
    const auto i = static_cast<std::size_t>(n);
    v[i] = (x[i] - start_[i]) / h;
  });
}

void XpbdSolver::predict(double h) {
  System& s = system();
  const Vec3Span x = s.x(), v = s.v(), f = s.f();
  const double keep = 1 / (1 + h * rayleighMass);
  parallelFor(s.size(), [&](Index n) {
    const auto i = static_cast<std::size_t>(n);
    const Vec3 push = h * inverseMass_[i] * f[i];
    const Mat3* projector = partlyHeld_.empty() ? nullptr : partlyHeld_[i];
    v[i] = keep * v[i] + (projector ? Vec3(*projector * push) : push);
    start_[i] = x[i];
    x[i] += h * v[i];
  });
}

XpbdParticles XpbdSolver::particlesOf(const Entry& entry, double h) {
  const std::size_t at = entry.offset, count = entry.count;
  std::span<const Mat3* const> partly(partlyHeld_);
  if (!partly.empty()) partly = partly.subspan(at, count);
  return {system().x().subspan(at, count), ConstVec3Span(start_).subspan(at, count),
          std::span<const double>(inverseMass_).subspan(at, count), partly, h};
}

}  // namespace stroma
