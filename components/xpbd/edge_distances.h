// SPDX-License-Identifier: Apache-2.0
// Constraints on the lengths of edges, C = |x_b - x_a| - L, of stiffness k = stiffness / L (N/m)
// with the force per strain `stiffness` (N): springs as those of MeshSpringForceField, in the form
// of Macklin, Müller, Chentanez 2016.
#pragma once

#include <vector>

#include "components/xpbd/colouring.h"
#include "components/xpbd/xpbd_constraint.h"

namespace stroma {

class EdgeDistances {
 public:
  // Every edge must name two points of `rest` that lie apart.
  EdgeDistances(ConstVec3Span rest, std::span<const Edge> edges);

  void setStiffness(double stiffness) { stiffness_ = stiffness; }
  [[nodiscard]] Index count() const { return static_cast<Index>(springs_.size()); }
  [[nodiscard]] Index colours() const { return colouring_.colours(); }

  void clearMultipliers();
  // One sweep. `damping` (s) times the stiffness is the damping coefficient of a constraint.
  // Returns how many edges were skipped: without length, thus without direction, or not finite.
  [[nodiscard]] std::uint64_t project(const XpbdParticles& particles, double damping);

 private:
  struct Spring {
    Edge nodes;
    double length;
  };
  [[nodiscard]] bool projectOne(const Spring& spring, double& multiplier,
                                const XpbdParticles& particles, double damping) const;

  Colouring colouring_;
  std::vector<Spring> springs_;  // in the order of the colouring
  std::vector<double> multipliers_;
  double stiffness_ = 0;
};

}  // namespace stroma
