// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/solver/stability_estimate.h"
#include "core/interfaces/integrator.h"

namespace stroma {

// Explicit Euler. Symplectic as in SOFA unless told otherwise: v += h M^-1 f(x, v), then x += h v
// with the new velocity (first order, and the same orbit as leapfrog with v half a step away).
// Rayleigh damping adds the force -rayleighMass M v + rayleighStiffness K v.
//
// A step is made in sub-steps of at most 0.9 times the largest stable one. That is estimated at the
// start, after a change of a run-time attribute and every `estimateEvery` steps, more often while
// it changes quickly, so that the number of sub-steps follows stiffening tissue; `currentSubsteps`
// shows it. Forces shown or written are those at the beginning of the last sub-step.
//
// Tissue may stiffen within a step by more than the estimate knows. The change of the accelerations
// over the way made shows it: |M^-1 (f - f_last)| / |x - x_last| is at most the largest eigenvalue
// of M^-1 K in between, and comes near to it as soon as a mode begins to grow. Then the estimate is
// made anew there; if it asks for more sub-steps the step begins again with these (counted as a
// limiter), a few times at most; so does one of long moves that has gained energy. Sub-steps that
// the scene fixes are not looked after.
class EulerExplicitSolver final : public Integrator {
 public:
  Attribute<bool> symplectic{this, "symplectic", true,
                             "Moves with the new velocity; false moves with the old one."};
  Attribute<double> rayleighStiffness{this,
                                      "rayleighStiffness",
                                      0.0,
                                      "Damping by this times the stiffness matrix.",
                                      {.unit = "s", .min = 0}};
  Attribute<double> rayleighMass{
      this, "rayleighMass", 0.0, "Damping by this times the masses.", {.unit = "1/s", .min = 0}};
  Attribute<int> substeps{
      this, "substeps", 0, "Sub-steps of a step; 0 = from the estimate of stability.", {.min = 0}};
  Attribute<int> maxSubsteps{
      this, "maxSubsteps", 10000, "Most sub-steps that the estimate may ask for.", {.min = 1}};
  Attribute<int> estimateEvery{
      this,
      "estimateEvery",
      20,
      "Steps between estimates of stability, at most: they are made more often while it changes "
      "quickly.",
      {.min = 1}};
  Attribute<int> currentSubsteps{
      this, "currentSubsteps", 1, "Sub-steps of the last step.", {.output = true}};
  Attribute<double> stableStep{this,
                               "stableStep",
                               0.0,
                               "Largest stable sub-step by the last estimate.",
                               {.unit = "s", .output = true}};
  Attribute<int> substepChanges{this,
                                "substepChanges",
                                0,
                                "How often the number of sub-steps has changed.",
                                {.output = true}};

  void start() override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  void integrate(const StepContext& step) override;
  void systemChanged() override { changed_ = true; }
  void topologyChanged(const TopologyChange&) override { cut_ = true; }
  [[nodiscard]] bool hasSubsteps() const override { return substeps != 1; }

 private:
  void estimate(double time, double dt, int iterations);
  void reestimate(const StepContext& step);
  void substep(double time, double h, bool watched);
  [[nodiscard]] bool makeSubsteps(const StepContext& step, bool watched);
  void watch(double h);
  [[nodiscard]] bool hasGained(const StepContext& step);
  [[nodiscard]] bool needsMoreSubsteps(const StepContext& step);

  Limiter capped_{this, "maxSubsteps",
                  "estimates that asked for more than `maxSubsteps` sub-steps"};
  Limiter repeated_{this, "repeated",
                    "steps begun again with more sub-steps because the tissue had stiffened"};
  bool changed_ = false, cut_ = false;  // since the last estimate
  int needed_ = 0;                      // sub-steps that a repeated step has needed, decaying
  int interval_ = 1;                    // steps between estimates now
  std::uint64_t nextEstimate_ = 2;      // step before which the next one is made
  StabilityEstimate stability_;
  bool tooStiff_ = false;                     // what the last sub-step has shown
  double spacing_ = 0;                        // m, of neighbouring particles
  double lastSpeed_ = 0;                      // m v^2 of the sub-step before
  std::vector<Vec3> startX_, startV_, last_;  // of the step; accelerations of the last sub-step
  std::vector<Vec3> heldForce_;               // forces on held particles, put back after the update
};

}  // namespace stroma
