// SPDX-License-Identifier: Apache-2.0
// The two constraints of a stable neo-Hookean tetrahedron (Macklin, Müller 2021),
//   C_D = |F|,   C_H = det F - g,   g = 1 + mu/l,
// of stiffness mu V and l V: together they are the energy V (mu/2 |F|^2 + l/2 (det F - g)^2), which
// rests at F = 1. F = D B, D the edges from node 0, B the inverse of D at rest, V the rest volume.
//
// Each constraint alone is far from zero at rest. The two multipliers of an element are therefore
// solved for together (a system of 2 x 2), and a body at rest is not moved. With mu = 0 what
// remains is a constraint on the volume, of stiffness l V.
//
// Elements of one colour are independent: four of them are computed at once, in the lanes of vector
// registers.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "components/xpbd/colouring.h"
#include "components/xpbd/xpbd_constraint.h"
#include "core/element_body.h"

namespace stroma {

struct TetrahedronModuli {
  double mu, l;  // Pa, mu >= 0, l > 0
};

// |F| and det F of one tetrahedron, or of several in the lanes of an array, and the derivatives by
// the positions of the nodes, [node][component].
template <class Scalar>
struct TetrahedronPair {
  using Vectors = std::array<std::array<Scalar, 3>, 3>;
  Scalar deviatoric, volume;
  std::array<std::array<Scalar, 3>, 4> dDeviatoric, dVolume;

  // `edges` are x_1 - x_0, x_2 - x_0, x_3 - x_0, `restInverse` the rows of B.
  TetrahedronPair(const Vectors& edges, const Vectors& restInverse);
};

class TetrahedronPairs {
 public:
  // Elements that have no positive volume at rest, up to rounding.
  [[nodiscard]] static ElementFlaw findFlaw(ConstVec3Span rest,
                                            std::span<const Tetrahedron> elements);

  // Every element must name points of `rest` and be without flaw.
  TetrahedronPairs(ConstVec3Span rest, std::span<const Tetrahedron> elements);

  void setModuli(const TetrahedronModuli& moduli) { moduli_ = moduli; }
  [[nodiscard]] Index count() const { return count_; }
  [[nodiscard]] Index colours() const { return static_cast<Index>(begin_.size()) - 1; }

  void clearMultipliers();
  // One sweep. `damping` (s) times the stiffness is the damping coefficient of a constraint.
  // Returns how many elements were skipped: crushed to a point (or, without mu, to a line), where
  // there is no gradient to follow, or not finite.
  [[nodiscard]] std::uint64_t project(const XpbdParticles& particles, double damping);

 private:
  static constexpr int lanes = 4;
  using Lanes = Eigen::Array<double, lanes, 1>;
  using Pair = TetrahedronPair<Lanes>;
  // Elements of one colour; what is left over is filled with the first one, whose result is not
  // used.
  struct Batch {
    std::array<Tetrahedron, lanes> nodes;
    int count;
    Lanes volume;
    Pair::Vectors restInverse;
    Lanes deviatoricMultiplier, volumeMultiplier;
  };
  [[nodiscard]] static Batch makeBatch(ConstVec3Span rest, std::span<const Tetrahedron> elements,
                                       std::span<const Index> chosen);
  [[nodiscard]] static Pair pairOf(const Batch& batch, ConstVec3Span x);
  static void restrictPair(Pair& pair, const Batch& batch, const XpbdParticles& particles);
  // Both return how many elements were skipped.
  [[nodiscard]] int projectBatch(Batch& batch, const XpbdParticles& particles,
                                 double damping) const;
  [[nodiscard]] int move(Batch& batch, const Pair& pair, const std::array<Lanes, 4>& w,
                         const Lanes& stepD, const Lanes& stepV, Vec3Span x) const;

  Index count_;
  std::vector<Batch> batches_;  // colour by colour
  std::vector<Index> begin_;    // of each colour, and the end
  TetrahedronModuli moduli_{0, 1};
};

template <class Scalar>
TetrahedronPair<Scalar>::TetrahedronPair(const Vectors& edges, const Vectors& restInverse) {
  Vectors F, cofactor;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      F[i][j] = edges[0][i] * restInverse[0][j] + edges[1][i] * restInverse[1][j] +
                edges[2][i] * restInverse[2][j];
    }
  }
  Scalar squares = F[0][0] * F[0][0];
  for (int k = 1; k < 9; ++k) squares += F[k / 3][k % 3] * F[k / 3][k % 3];
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactor[i][j] = F[i1][j1] * F[i2][j2] - F[i1][j2] * F[i2][j1];
    }
  }
  using std::sqrt;
  deviatoric = sqrt(squares);
  volume = F[0][0] * cofactor[0][0] + F[1][0] * cofactor[1][0] + F[2][0] * cofactor[2][0];
  const Scalar scale = 1 / deviatoric;
  const auto by = [&](const Vectors& A, int a, int i) -> Scalar {
    return A[i][0] * restInverse[a][0] + A[i][1] * restInverse[a][1] + A[i][2] * restInverse[a][2];
  };
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) {
      dDeviatoric[a + 1][i] = scale * by(F, a, i);
      dVolume[a + 1][i] = by(cofactor, a, i);
    }
    dDeviatoric[0][i] = -(dDeviatoric[1][i] + dDeviatoric[2][i] + dDeviatoric[3][i]);
    dVolume[0][i] = -(dVolume[1][i] + dVolume[2][i] + dVolume[3][i]);
  }
}

}  // namespace stroma
