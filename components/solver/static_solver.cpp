// SPDX-License-Identifier: Apache-2.0
#include "components/solver/static_solver.h"

#include <algorithm>
#include <limits>

#include "core/snapshot.h"

namespace stroma {

void StaticSolver::start() {
  rest_.assign(static_cast<std::size_t>(system().size()), Vec3::Zero());
}

void StaticSolver::save(StateWriter& writer) const { writer.write("load", load_); }

void StaticSolver::restore(StateReader& reader) {
  if (!reader.read("load", load_)) load_ = 0;
}

void StaticSolver::integrate(const StepContext& step) {
  std::ranges::fill(system().v(), Vec3::Zero());
  lastNewtonIterations.set(0);
  lastLinearIterations.set(0);
  for (int k = 1; k <= loadSteps; ++k) solveAt(step.time + step.dt * k / loadSteps);
}

void StaticSolver::solveAt(double time) {
  System& s = system();
  time_ = time;
  load_ = std::max(load_, newton_.residualAt(*this, s.x()));
  const NewtonResult result = newton_.minimise(*this, s.x(), {newtonIterations, tolerance * load_});
  if (!result.converged) ++notConverged_;
  lineSearchFailed_.add(static_cast<std::uint64_t>(result.lineSearchFailures));
  lastNewtonIterations.set(lastNewtonIterations + result.iterations);
  lastResidual.set(load_ > 0 ? result.residual / load_ : 0);
}

double StaticSolver::energy(ConstVec3Span x) { return system().potentialEnergy({x, rest_, time_}); }

void StaticSolver::residual(ConstVec3Span x, Vec3Span r) {
  System& s = system();
  s.computeForce({x, rest_, time_}, s.f());
  std::ranges::copy(s.f(), r.begin());
  s.project(r);
}

void StaticSolver::direction(ConstVec3Span x, ConstVec3Span r, Vec3Span d) {
  System& s = system();
  s.linearize({x, rest_, time_});
  const LinearSolution solution = linearSolver->solve(SystemMatrix{s, 0, 0, 1}, r, d);
  lastLinearIterations.set(lastLinearIterations + solution.iterations);
}

double StaticSolver::rounding(ConstVec3Span x) const {
  return 2 * std::numeric_limits<double>::epsilon() * flat(x).cwiseAbs().maxCoeff();
}

}  // namespace stroma
