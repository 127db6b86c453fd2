// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/schedule.h"
#include "core/system.h"

namespace stroma {

// Advances the states of its node and of everything below it, down to the next integrator. SOFA
// calls these "ODE solvers".
class Integrator : public Component {
 public:
  static constexpr std::string_view role = "Integrator";

  // Advances system() from step.time to step.time + step.dt.
  virtual void integrate(const StepContext& step) = 0;
  // A component that it governs has a new run-time value: forces and stiffness may have changed.
  virtual void systemChanged() {}
  // Whether a step makes one linear solve, which cannot find out which one-sided forces let go.
  [[nodiscard]] virtual bool solvesOnce() const { return false; }
  // Whether a step is, or may be, made in several sub-steps. What is found once a step, such as
  // contacts, then stands for all of them.
  [[nodiscard]] virtual bool hasSubsteps() const { return false; }
  [[nodiscard]] System& system() const { return *system_; }
  void setSystem(System* system) { system_ = system; }

  void schedule(Schedule& schedule) override {
    schedule.add<&Integrator::integrate>(Stage::Solve, *this, "integrate");
  }

 private:
  System* system_ = nullptr;
};

}  // namespace stroma
