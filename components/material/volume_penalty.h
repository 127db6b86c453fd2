// SPDX-License-Identifier: Apache-2.0
// Penalty on the change of volume (Mueller, Keiser, Nealen, Pauly, Gross, Alexa 2004):
//   psi = k/2 (J - 1)^2,  P = k (J - 1) cof F,  J = det F, k in Pa.
// It adds k to the bulk modulus of the law that it accompanies.
#pragma once

#include <stdexcept>

#include "components/material/stable_neo_hookean.h"

namespace stroma {

class VolumePenalty {
 public:
  struct Tangent {
    Mat3 F, cofactor;
    double pressure;
  };
  using FilteredTangent = PrincipalTangent;

  explicit VolumePenalty(double stiffness) : k_(stiffness) {
    if (!(stiffness >= 0)) throw std::invalid_argument("volume stiffness must not be negative");
  }

  [[nodiscard]] double energy(const Mat3& F) const {
    const double change = F.determinant() - 1;
    return 0.5 * k_ * change * change;
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const {
    const Mat3 C = cofactorMatrix(F);
    return k_ * (F.col(0).dot(C.col(0)) - 1) * C;
  }
  [[nodiscard]] Tangent tangent(const Mat3& F) const {
    const Mat3 C = cofactorMatrix(F);
    return {F, C, k_ * (F.col(0).dot(C.col(0)) - 1)};
  }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    return k_ * t.cofactor.cwiseProduct(dF).sum() * t.cofactor +
           t.pressure * cofactorDerivative(t.F, dF);
  }
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    const PrincipalFrame frame = principalFrame(F);
    const Vec3& s = frame.sigma;
    const Vec3 area(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
    const double pressure = k_ * (s[0] * area[0] - 1);
    PrincipalTangent t{frame.U, frame.V, k_ * area * area.transpose(), pressure * s, -pressure * s};
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      t.scale(i, j) += pressure * s[k];
      t.scale(j, i) += pressure * s[k];
    }
    t.projectPositive();
    return t;
  }
  [[nodiscard]] Mat3 dStress(const FilteredTangent& t, const Mat3& dF) const { return t.apply(dF); }

 private:
  double k_;
};

}  // namespace stroma
