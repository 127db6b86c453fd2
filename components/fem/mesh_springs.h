// SPDX-License-Identifier: Apache-2.0
// Damped linear springs between particles: energy k/2 (L - L0)^2 of each, force on either end
// k (L - L0) n towards the other, n its direction, and damping d (n . dv) n. Every particle gathers
// from its own springs in a fixed order: the same bits at any number of threads, and both momenta
// are kept to rounding. Units: SI.
#pragma once

#include <array>
#include <vector>

#include "core/block_matrix.h"

namespace stroma {

struct Spring {
  std::array<Index, 2> ends;
  double stiffness;  // k, N/m
  double damping;    // d, N s/m
  double length;     // L0, m
};

class MeshSprings {
 public:
  // Springs that only pull have no force while they are shorter than at rest.
  MeshSprings(Index particles, std::span<const Spring> springs, bool onlyPull);

  [[nodiscard]] Index springCount() const { return static_cast<Index>(links_.size() / 2); }
  [[nodiscard]] std::size_t springsOf(Index i) const { return row(i).size(); }

  void addForces(ConstVec3Span x, ConstVec3Span v, Vec3Span f) const;
  [[nodiscard]] double energy(ConstVec3Span x) const;
  // Keeps the derivatives at x. Filtered leaves out the part of a spring under compression that
  // makes it buckle: the tangent is then positive semi-definite. That damping turns with the spring
  // is left out of its derivative.
  void prepareTangent(ConstVec3Span x, bool filtered);
  // df += stiffness (df/dx) dx + damping (df/dv) dx
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping, Vec3Span df) const;
  void addPattern(BlockPattern& pattern, Index offset) const;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness, double damping) const;

 private:
  struct Link {
    Index other;
    double stiffness, damping, length;
  };
  // -d force / d(x_i - x_j) = lateral I + (k - lateral) n n^T while the spring acts
  struct Tangent {
    Vec3 n;
    double lateral, axial, damping;
  };
  [[nodiscard]] std::span<const Link> row(Index i) const {
    return std::span(links_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }
  [[nodiscard]] bool acts(const Link& link, double length) const {
    return !onlyPull_ || length > link.length;
  }
  static Tangent scaled(const Tangent& t, double stiffness, double damping);

  std::vector<Index> begin_;
  std::vector<Link> links_;  // each spring at both of its ends
  std::vector<Tangent> tangents_;
  bool onlyPull_;
};

}  // namespace stroma
