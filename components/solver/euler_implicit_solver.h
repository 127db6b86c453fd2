// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/solver/newton.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/linear_solver.h"

namespace stroma {

// Implicit Euler. With newtonIterations = 1, as in SOFA, one linear system a step (Baraff & Witkin
// 1998),
//
//   (M (1 + h rM) - h B - h (h + rK) K) dv = h (f + (h + rK) K v - rM M v),   v += dv,   x += h v,
//
// K = df/dx, B = df/dv, rM and rK the Rayleigh factors. With more, Newton's method with a line
// search on the incremental potential (Gast et al. 2015), whose minimum is the exact implicit Euler
// step:
//
//   |v - v_n|^2_M / 2 + U(x_n + h v) + h/2 v.D v,   D = rM M - rK K - B taken at the beginning of
//   the step.
//
// Its first iteration, from v = 0, is the linear solve above. A step that is not converged within
// newtonIterations is used as it is and counted as a limiter.
//
// Neither may create energy: in a step that moves a particle by more than `carefulMove` times the
// particles' distance the energy is compared with that before, the loads already moved on, and the
// velocities are shortened towards those of the centre of mass (or zero, where something is held)
// until it has not grown. Shorter moves are as good as linear and are not looked at, so that an
// ordinary step costs nothing more; a shortened one costs at most 40 energies. Counted as a
// limiter.
class EulerImplicitSolver final : public Integrator, private NewtonProblem {
 public:
  Attribute<double> rayleighStiffness{this,
                                      "rayleighStiffness",
                                      0.0,
                                      "Damping by this times the stiffness matrix.",
                                      {.unit = "s", .min = 0, .runtime = true}};
  Attribute<double> rayleighMass{this,
                                 "rayleighMass",
                                 0.0,
                                 "Damping by this times the masses.",
                                 {.unit = "1/s", .min = 0, .runtime = true}};
  Attribute<double> vdamping{this,
                             "vdamping",
                             0.0,
                             "Velocities are multiplied by exp(-dt vdamping) after each step.",
                             {.unit = "1/s", .min = 0, .runtime = true}};
  Attribute<bool> trapezoidalScheme{
      this, "trapezoidalScheme", false,
      "Takes the forces at the middle of the step: second order, less "
      "damping. With newtonIterations = 1 only."};
  Attribute<int> newtonIterations{this,
                                  "newtonIterations",
                                  1,
                                  "1 = one linear solve a step; more = Newton's method.",
                                  {.min = 1}};
  Attribute<double> tolerance{this,
                              "tolerance",
                              1e-6,
                              "Newton's method ends at this residual, relative to the one at its "
                              "start.",
                              {.min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> carefulMove{
      this,
      "carefulMove",
      0.1,
      "Steps that move a particle by more than this times the distance of particles may not add "
      "energy; 0 = none may.",
      {.min = 0}};
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
                                 "Relative residual at the end of the last step.",
                                 {.output = true}};
  Link<LinearSolver> linearSolver{this, "linearSolver", "Solves the linear systems.",
                                  Lookup::nearest};

  void configure() override;
  void start() override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  void integrate(const StepContext& step) override;
  [[nodiscard]] bool solvesOnce() const override { return newtonIterations == 1; }

 private:
  void linearStep(const StepContext& step);
  void newtonStep();
  void keepEnergy();
  void shorten();
  [[nodiscard]] double energyWith(double part);
  [[nodiscard]] double energy(ConstVec3Span v) override;
  void residual(ConstVec3Span v, Vec3Span r) override;
  void direction(ConstVec3Span v, ConstVec3Span r, Vec3Span d) override;
  [[nodiscard]] double rounding(ConstVec3Span v) const override;
  void moveTo(ConstVec3Span v);
  void dampingForce(ConstVec3Span v);

  Limiter notConverged_{this, "notConverged",
                        "steps whose Newton iteration did not reach `tolerance`"};
  Limiter lineSearchFailed_{this, "lineSearchFailed",
                            "Newton steps along which the energy did not fall"};
  Limiter shortened_{this, "shortened", "steps shortened because they would have added energy"};
  Newton newton_;
  std::vector<Vec3> b_, dv_;           // right-hand side, last solution
  std::vector<Vec3> x0_, v0_, moved_;  // start of the step, trial positions
  std::vector<Vec3> damping_;          // D v
  std::vector<Vec3> full_;             // velocities of a step that is shortened
  Vec3 base_ = Vec3::Zero();           // velocity that it is shortened towards
  double spacing_ = 0;                 // m, of neighbouring particles
  double h_ = 0, time_ = 0;
  bool damps_ = false;
};

}  // namespace stroma
