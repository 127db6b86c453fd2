// SPDX-License-Identifier: Apache-2.0
// Largest stable step of explicit (symplectic Euler, leapfrog) integration, 2 / omega_max, with
// omega_max^2 the largest eigenvalue of M^-1 K by power iteration from a fixed start, so that the
// answer has the same bits every time. Power iteration comes from below; the estimate is therefore
// used with a safety factor.
#pragma once

#include <cmath>

#include "core/types.h"

namespace stroma {

// product(x, y) must set y = K x; masses in kg, positive. Returns omega_max^2 in 1/s^2.
template <class Product>
[[nodiscard]] double largestEigenfrequencySquared(std::span<const double> masses, Product&& product,
                                                  int iterations = 40) {
  std::vector<Vec3> x(masses.size()), y(masses.size());
  // a fixed pseudo-random start has a part along every mode
  std::uint32_t state = 12345;
  for (std::size_t i = 0; i < masses.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      state = state * 1664525u + 1013904223u;
      x[i][c] = state / 4294967296.0 - 0.5;
    }
  double value = 0;
  for (int k = 0; k < iterations; ++k) {
    // x has unit mass norm, so that x.K x is the Rayleigh quotient
    double norm = 0, energy = 0;
    for (std::size_t i = 0; i < masses.size(); ++i) norm += masses[i] * x[i].squaredNorm();
    const double scale = norm > 0 ? 1 / std::sqrt(norm) : 0;
    for (Vec3& v : x) v *= scale;
    product(ConstVec3Span(x), Vec3Span(y));
    for (std::size_t i = 0; i < masses.size(); ++i) energy += x[i].dot(y[i]);
    value = std::max(value, energy);
    for (std::size_t i = 0; i < masses.size(); ++i) x[i] = y[i] / masses[i];
  }
  return value;
}

// Critical step in s; infinite where nothing resists motion.
[[nodiscard]] inline double criticalTimeStep(double eigenfrequencySquared) {
  return 2 / std::sqrt(eigenfrequencySquared);
}

}  // namespace stroma
