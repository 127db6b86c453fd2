// SPDX-License-Identifier: Apache-2.0
// The two laws at one point of contact. Both are gradients of an energy, so that solvers that
// minimise one see it whole.
#pragma once

#include <algorithm>

#include "core/types.h"

namespace stroma {

// Normal penalty (one-sided spring): energy k/2 d^2 for a depth d > 0; beyond `cap` the force grows
// no more. Where `held` it is a spring to both sides.
struct PenaltyLaw {
  double stiffness, cap;  // N/m, m
  bool held = false;
  [[nodiscard]] bool acts(double depth) const { return held || depth > 0; }
  [[nodiscard]] double force(double depth) const {
    return acts(depth) ? stiffness * std::min(depth, cap) : 0;
  }
  [[nodiscard]] double tangent(double depth) const {
    return acts(depth) && depth < cap ? stiffness : 0;
  }
  [[nodiscard]] double energy(double depth) const {
    if (!acts(depth)) return 0;
    const double d = std::min(depth, cap);
    return 0.5 * stiffness * d * d + stiffness * cap * (depth - d);
  }
};

// Coulomb friction as an anchored spring across the normal that slips when its force would pass
// `limit` (N): k/2 |e|^2 up to there, straight beyond (Huber 1964).
struct FrictionLaw {
  double stiffness, limit;
  // Force on the surface for the spring's stretch e (m), that lies across the normal.
  [[nodiscard]] Vec3 force(const Vec3& e) const {
    const double length = e.norm();
    return sticks(length) ? Vec3(stiffness * e) : Vec3((limit / length) * e);
  }
  // d force / d e; `across` is the projector across the normal.
  [[nodiscard]] Mat3 tangent(const Vec3& e, const Mat3& across) const {
    const double length = e.norm();
    if (sticks(length)) return stiffness * across;
    return (limit / length) * (across - e * e.transpose() / (length * length));
  }
  [[nodiscard]] double energy(const Vec3& e) const {
    const double length = e.norm();
    return sticks(length) ? 0.5 * stiffness * length * length
                          : limit * (length - 0.5 * limit / stiffness);
  }

 private:
  [[nodiscard]] bool sticks(double length) const { return stiffness * length <= limit; }
};

}  // namespace stroma
