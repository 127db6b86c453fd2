// SPDX-License-Identifier: Apache-2.0
#include "components/solver/cg_linear_solver.h"
#include "components/solver/euler_explicit_solver.h"
#include "components/solver/euler_implicit_solver.h"
#include "components/solver/sparse_ldl_solver.h"
#include "components/solver/static_solver.h"
#include "core/plugin.h"

PLUGIN(solver, "0.1.0", "Apache-2.0", "Time integration, static equilibrium, linear solvers.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<EulerExplicitSolver>("EulerExplicitSolver")
      .doc("Explicit (symplectic) Euler in sub-steps that an estimate of stability chooses.")
      .domain(
          "First order; energy stays bounded below the stability limit. Verified on a spring and a "
          "mass against the analytic oscillator, with and without Rayleigh damping.")
      .example("scenes/paper/cornea.xml");
  registry.add<EulerImplicitSolver>("EulerImplicitSolver")
      .doc(
          "Implicit Euler: one linear solve a step as in SOFA, or Newton's method with line "
          "search.")
      .domain(
          "First order and damping in time at any step size; second order with trapezoidalScheme. "
          "Verified on the analytic damped oscillator; energy never rises.")
      .example("scenes/cornea/pull.xml");
  registry.add<StaticSolver>("StaticSolver")
      .doc("Static equilibrium at the end of each step by Newton's method with line search.")
      .domain(
          "Bodies held against rigid motion; finds a minimum of the energy, not points beyond "
          "buckling. Verified on nonlinear springs.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<CGLinearSolver>("CGLinearSolver")
      .doc("Conjugate gradients without a matrix, to a relative residual.")
      .domain("Symmetric positive definite systems. Verified against dense solves.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<SparseLDLSolver>("SparseLDLSolver")
      .doc("Sparse factors of the assembled matrix, kept over steps while they still converge.")
      .domain(
          "Symmetric systems; others than positive definite ones are shifted and counted. Verified "
          "against dense solves, with new and kept factors.")
      .example("scenes/cornea/pull.xml");
}
