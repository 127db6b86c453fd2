// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/snapshot.h"
#include "core/system.h"

namespace stroma {

// Estimates the largest time step of symplectic Euler by power iteration.
//
// With w^2 the largest eigenvalue of M^-1 K and c that of M^-1 C (K = -df/dx, C the damping
// matrix), the step is stable when h^2 w^2 + 2 h c < 4; without damping that is h < 2 / w. Each
// iterate's |M^-1 K x| / |x| (norms by M) approaches its eigenvalue from below, so a safety factor
// belongs to the result. The vectors are kept: later estimates start from them and take few
// iterations.
class StabilityEstimate {
 public:
  // Estimates for the state last linearised, by at most `iterations` products with each of the two
  // matrices; `rayleighMass` and `rayleighStiffness` add to the damping.
  void update(const System& system, double rayleighMass, double rayleighStiffness, int iterations);
  // Largest stable step (s), infinite when nothing moves.
  [[nodiscard]] double largestStep() const;
  // Something local has changed, such as by a cut: the modes found before get a part of every
  // other, so that one which has grown stiffer shows in few products.
  void disturb(const System& system);
  void forget() { stiffnessVector_.clear(), dampingVector_.clear(); }

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  [[nodiscard]] double largestEigenvalue(const System& system, double stiffness, double damping,
                                         int iterations, std::vector<Vec3>& vector);
  double stiffness_ = 0, damping_ = 0;  // w^2 (1/s^2), c (1/s)
  std::vector<Vec3> stiffnessVector_, dampingVector_, image_;
};

}  // namespace stroma
