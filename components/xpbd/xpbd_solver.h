// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/xpbd/xpbd_constraint.h"
#include "core/interfaces/integrator.h"

namespace stroma {

// Extended position based dynamics (Macklin, Müller, Chentanez 2016) in small steps (Macklin et al.
// 2019). A sub-step of length h:
//   v <- v / (1 + h rayleighMass) + h M^-1 f(x, v),   x* = x + h v      prediction
//   x* is moved by the constraints, `iterations` sweeps, multipliers zero at the first
//   v <- (x* - x) / h,   x <- x*
// f are the forces of all force fields of the system and gravity, explicit: a stiff one limits the
// sub-step as with EulerExplicitSolver. Constraints are the XpbdConstraint of the system's states.
//
// Bodies at rest approach the minimum of their energy with the square of h; too long sub-steps make
// them softer, see README.md. Forces shown or written are f at the beginning of the last sub-step,
// thus without those of the constraints.
class XpbdSolver final : public Integrator {
 public:
  Attribute<int> substeps{this, "substeps", 10, "Sub-steps of a step.", {.min = 1}};
  Attribute<int> iterations{this,
                            "iterations",
                            1,
                            "Sweeps over all constraints in a sub-step.",
                            {.min = 1, .runtime = true}};
  Attribute<double> rayleighMass{this,
                                 "rayleighMass",
                                 0.0,
                                 "Damping by this times the masses.",
                                 {.unit = "1/s", .min = 0, .runtime = true}};
  Attribute<int> constraintCount{
      this, "constraintCount", 0, "Constraints of a sweep, each on one number.", {.output = true}};

  void start() override;
  void reset() override { system().project(system().v()); }
  void integrate(const StepContext& step) override;
  [[nodiscard]] bool hasSubsteps() const override { return substeps != 1; }

 private:
  struct Entry {
    XpbdConstraint* constraint;
    std::size_t offset, count;  // of its state's particles
  };
  void gatherConstraints();
  void gatherHeld();
  void substep(double time, double h);
  void predict(double h);
  [[nodiscard]] XpbdParticles particlesOf(const Entry& entry, double h);

  std::vector<Entry> constraints_;
  std::vector<Vec3> start_;              // positions at the beginning of the sub-step
  std::vector<double> inverseMass_;      // 0 for wholly held particles
  std::vector<const Mat3*> partlyHeld_;  // empty without such particles
};

}  // namespace stroma
