// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/solver/newton.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/linear_solver.h"

namespace stroma {

// Static equilibrium at the end of each step: Newton's method with a line search on the potential
// energy. Masses matter for gravity only; velocities are zero. Ends when the sum of forces is
// `tolerance` times the largest one that any step has begun with (the load), or when increments are
// down to rounding. A step that does not get there is used as it is and counted as a limiter.
class StaticSolver final : public Integrator, private NewtonProblem {
 public:
  Attribute<int> newtonIterations{this,
                                  "newtonIterations",
                                  50,
                                  "Most Newton iterations a solve.",
                                  {.min = 1, .runtime = true, .aliases = "newton_iterations"}};
  Attribute<double> tolerance{this,
                              "tolerance",
                              1e-6,
                              "Accepted unbalanced force, relative to the load.",
                              {.min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<int> loadSteps{this,
                           "loadSteps",
                           1,
                           "Equilibria found on the way through a step, at equal times: for loads "
                           "that rise with time faster than one solve can follow.",
                           {.min = 1, .runtime = true}};
  Attribute<int> lastNewtonIterations{
      this, "lastNewtonIterations", 0, "Newton iterations of the last step.", {.output = true}};
  Attribute<int> lastLinearIterations{this,
                                      "lastLinearIterations",
                                      0,
                                      "Linear solver's iterations in the last step.",
                                      {.output = true}};
  Attribute<double> lastResidual{this,
                                 "lastResidual",
                                 0.0,
                                 "Unbalanced force, relative to the load, after the last step.",
                                 {.output = true}};
  Link<LinearSolver> linearSolver{this, "linearSolver", "Solves the linear systems.",
                                  Lookup::nearest};

  void start() override;
  void reset() override { load_ = 0; }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  void integrate(const StepContext& step) override;

 private:
  void solveAt(double time);
  [[nodiscard]] double energy(ConstVec3Span x) override;
  void residual(ConstVec3Span x, Vec3Span r) override;
  void direction(ConstVec3Span x, ConstVec3Span r, Vec3Span d) override;
  [[nodiscard]] double rounding(ConstVec3Span x) const override;

  Limiter notConverged_{this, "notConverged", "solves that did not reach `tolerance`"};
  Limiter lineSearchFailed_{this, "lineSearchFailed",
                            "Newton steps along which the energy did not fall"};
  Newton newton_;
  double load_ = 0;  // largest unbalanced force (N) that a solve has begun with
  double time_ = 0;
  std::vector<Vec3> rest_;  // velocities of zero
};

}  // namespace stroma
