// SPDX-License-Identifier: Apache-2.0
// Neo-Hookean solid whose shape and volume are separate (Simo, Taylor, Pister 1985):
//   psi = mu/2 (J^(-2/3) I - 3) + k/2 log(J)^2,  I = |F|^2, J = det F,
//   P = a F + b/J cof F,  a = mu J^(-2/3),  b = k log(J) - a I/3,
// with the shear modulus mu and the bulk modulus k. The energy grows without bound as a volume goes
// to zero and is infinite beyond: a step that inverts a volume has no force, and StableNeoHookean
// is the law that survives it. Units: Pa, J/m^3.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "components/material/lame.h"
#include "components/material/stable_neo_hookean.h"

namespace stroma {

class NeoHookean {
 public:
  struct Tangent {
    Mat3 F, cofactor;
    double J, a, b;
  };
  using FilteredTangent = PrincipalTangent;

  struct Moduli {
    double shear, bulk;  // Pa, positive
  };
  explicit NeoHookean(const Moduli& moduli) : mu_(moduli.shear), k_(moduli.bulk) {
    if (!(mu_ > 0 && k_ > 0)) throw std::invalid_argument("moduli must be positive");
  }
  NeoHookean(double youngModulus, double poissonRatio)
      : NeoHookean(modulusOf(Lame(youngModulus, poissonRatio))) {}

  [[nodiscard]] double energy(const Mat3& F) const {
    const double J = F.determinant();
    if (!(J > 0)) return std::numeric_limits<double>::infinity();
    const double growth = std::log(J);
    return 0.5 * mu_ * (std::pow(J, -2.0 / 3) * F.squaredNorm() - 3) + 0.5 * k_ * growth * growth;
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const {
    const Tangent t = tangent(F);
    return t.a * F + t.b / t.J * t.cofactor;
  }
  [[nodiscard]] Tangent tangent(const Mat3& F) const {
    const Mat3 C = cofactorMatrix(F);
    const double J = F.col(0).dot(C.col(0));
    const double a = mu_ * std::pow(J, -2.0 / 3);
    return {F, C, J, a, k_ * std::log(J) - a * F.squaredNorm() / 3};
  }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    const double swell = t.cofactor.cwiseProduct(dF).sum() / t.J;
    const double da = -2.0 / 3 * t.a * swell;
    const double db =
        k_ * swell - (da * t.F.squaredNorm() + 2 * t.a * t.F.cwiseProduct(dF).sum()) / 3;
    return t.a * dF + da * t.F + (db - t.b * swell) / t.J * t.cofactor +
           t.b / t.J * cofactorDerivative(t.F, dF);
  }

  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    const PrincipalFrame frame = principalFrame(F);
    const Vec3& s = frame.sigma;
    const double J = s.prod(), I = s.squaredNorm();
    const double a = mu_ * std::pow(J, -2.0 / 3), b = k_ * std::log(J) - a * I / 3;
    PrincipalTangent t{frame.U, frame.V, {}, {}, {}};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        t.scale(i, j) =
            (k_ + 2.0 / 9 * a * I) / (s[i] * s[j]) - 2.0 / 3 * a * (s[i] / s[j] + s[j] / s[i]);
      }
      t.scale(i, i) += a - b / (s[i] * s[i]);
      const double others = s[(i + 1) % 3] * s[(i + 2) % 3];
      t.twist[i] = a + b / others;
      t.flip[i] = a - b / others;
    }
    t.projectPositive();
    return t;
  }
  [[nodiscard]] Mat3 dStress(const FilteredTangent& t, const Mat3& dF) const { return t.apply(dF); }

 private:
  static Moduli modulusOf(const Lame& lame) { return {lame.mu, lame.lambda + 2 * lame.mu / 3}; }

  double mu_, k_;
};

}  // namespace stroma
