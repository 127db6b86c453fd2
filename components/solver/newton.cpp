// SPDX-License-Identifier: Apache-2.0
#include "components/solver/newton.h"

#include <algorithm>
#include <cmath>

#include "components/solver/conjugate_gradient.h"
#include "core/parallel.h"

namespace stroma {
namespace {

constexpr double armijo = 1e-4;
constexpr int maxShortenings = 20;

double norm(ConstVec3Span a) { return std::sqrt(dot(a, a)); }

double largest(ConstVec3Span a) { return flat(a).size() ? flat(a).cwiseAbs().maxCoeff() : 0.0; }

}  // namespace

double Newton::residualAt(NewtonProblem& problem, ConstVec3Span u) {
  r_.resize(u.size());
  problem.residual(u, r_);
  return norm(r_);
}

NewtonResult Newton::minimise(NewtonProblem& problem, Vec3Span u, const NewtonOptions& options) {
  for (auto* a : {&r_, &d_, &trial_, &trialResidual_}) a->resize(u.size());
  NewtonResult result;
  problem.residual(u, r_);
  result.residual = norm(r_);
  while (!(result.converged = result.residual <= options.residual) &&
         result.iterations < options.iterations) {
    ++result.iterations;
    std::ranges::fill(d_, Vec3::Zero());
    problem.direction(u, r_, d_);
    if (largest(d_) <= problem.rounding(u)) {
      result.converged = true;
      break;
    }
    const Search found = search(problem, u);
    const double next = norm(trialResidual_);
    if (found == Search::failed) {
      ++result.lineSearchFailures;
      if (!(next < result.residual)) {
        problem.residual(u, r_);  // forces shown are those of the state that is kept
        break;
      }
    }
    std::ranges::copy(trial_, u.begin());
    std::ranges::copy(trialResidual_, r_.begin());
    result.residual = next;
  }
  return result;
}

void Newton::tryStep(NewtonProblem& problem, ConstVec3Span u, double length) {
  parallelFor(static_cast<Index>(u.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    trial_[i] = u[i] + length * d_[i];
  });
  problem.residual(trial_, trialResidual_);
}

Newton::Search Newton::search(NewtonProblem& problem, Vec3Span u) {
  const double slope = -dot(r_, d_), size = norm(r_);
  const double energy = problem.energy(u);
  double length = 1;
  if (slope < 0) {
    for (int k = 0; k < maxShortenings; ++k) {
      tryStep(problem, u, length);
      const double change = problem.energy(trial_) - energy;
      if (change <= armijo * length * slope) return Search::accepted;
      const double nextSlope = -dot(trialResidual_, d_);
      if (std::abs(nextSlope) <= 0.5 * std::abs(slope) && norm(trialResidual_) < 0.9 * size) {
        return Search::accepted;
      }
      // minimum of the parabola through energy, slope and the new energy, kept in sensible bounds
      const double parabola = -0.5 * slope * length * length / (change - slope * length);
      length =
          std::isfinite(parabola) ? std::clamp(parabola, 0.1 * length, 0.5 * length) : 0.1 * length;
    }
  }
  tryStep(problem, u, 1);
  return Search::failed;
}

}  // namespace stroma
