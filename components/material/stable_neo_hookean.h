// SPDX-License-Identifier: Apache-2.0
// Stable neo-Hookean solid (Smith, de Goes, Kim 2018):
//   psi = m/2 (I - 3) + l/2 (J - a)^2 - c m/2 log(I + 1),  I = |F|^2, J = det F,
//   P = m (1 - c/(I + 1)) F + l (J - a) cof F.
// Form::smith2018 has c = 1, m = 4/3 mu, l = lambda + 5/6 mu, which keeps a solid crushed to a
// point from resting there. Form::classic has c = 0, m = mu, l = lambda + mu: the textbook
// neo-Hookean solid where the volume is kept, P/mu = s - 1/s^2 at the uniaxial stretch s, of which
// smith2018 is 11 % above at s = 2. With a = 1 + (1 - c/4) m/l both rest at F = I and have the
// small-strain moduli of the Young's modulus and Poisson's ratio asked for. Defined and smooth for
// every F, inverted ones included. psi is shifted to be zero at rest. Units: Pa, J/m^3.
#pragma once

#include <cmath>

#include "components/material/lame.h"
#include "components/material/principal_tangent.h"

namespace stroma {

// Cofactor matrix: the derivative of det F.
[[nodiscard]] inline Mat3 cofactorMatrix(const Mat3& F) {
  Mat3 C;
  C.col(0) = F.col(1).cross(F.col(2));
  C.col(1) = F.col(2).cross(F.col(0));
  C.col(2) = F.col(0).cross(F.col(1));
  return C;
}

// Derivative of the cofactor matrix in the direction dF.
[[nodiscard]] inline Mat3 cofactorDerivative(const Mat3& F, const Mat3& dF) {
  Mat3 C;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    C.col(k) = dF.col(i).cross(F.col(j)) + F.col(i).cross(dF.col(j));
  }
  return C;
}

class StableNeoHookean {
 public:
  enum class Form { smith2018, classic };
  struct Tangent {
    Mat3 F, cofactor;
    double invariant, pressure;  // I + 1 and l (J - a)
  };
  using FilteredTangent = PrincipalTangent;

  StableNeoHookean(double youngModulus, double poissonRatio, Form form = Form::smith2018)
      : StableNeoHookean(Lame(youngModulus, poissonRatio), form) {}

  [[nodiscard]] double energy(const Mat3& F) const {
    const double I = F.squaredNorm(), volume = F.determinant() - a_;
    return 0.5 * m_ * (I - 3 - c_ * std::log((I + 1) / 4)) +
           0.5 * l_ * (volume * volume - (1 - a_) * (1 - a_));
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const {
    const Mat3 C = cofactorMatrix(F);
    const double J = F.col(0).dot(C.col(0));
    return m_ * (1 - c_ / (F.squaredNorm() + 1)) * F + l_ * (J - a_) * C;
  }

  [[nodiscard]] Tangent tangent(const Mat3& F) const {
    const Mat3 C = cofactorMatrix(F);
    return {F, C, F.squaredNorm() + 1, l_ * (F.col(0).dot(C.col(0)) - a_)};
  }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    const double stretch = t.F.cwiseProduct(dF).sum(), swell = t.cofactor.cwiseProduct(dF).sum();
    return m_ * (1 - c_ / t.invariant) * dF +
           (2 * c_ * m_ / (t.invariant * t.invariant) * stretch) * t.F + l_ * swell * t.cofactor +
           t.pressure * cofactorDerivative(t.F, dF);
  }

  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    const PrincipalFrame frame = principalFrame(F);
    const Vec3& s = frame.sigma;
    const Vec3 area(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
    const double I1 = s.squaredNorm() + 1, shear = m_ * (1 - c_ / I1);
    const double pressure = l_ * (s[0] * area[0] - a_);
    PrincipalTangent t{frame.U, frame.V, 2 * c_ * m_ / (I1 * I1) * s * s.transpose(), {}, {}};
    t.scale += l_ * area * area.transpose();
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      t.scale(k, k) += shear;
      t.scale(i, j) += pressure * s[k];
      t.scale(j, i) += pressure * s[k];
      t.twist[k] = shear + pressure * s[k];
      t.flip[k] = shear - pressure * s[k];
    }
    t.projectPositive();
    return t;
  }
  [[nodiscard]] Mat3 dStress(const FilteredTangent& t, const Mat3& dF) const { return t.apply(dF); }

 private:
  StableNeoHookean(const Lame& lame, Form form)
      : c_(form == Form::smith2018 ? 1 : 0),
        m_((1 + c_ / 3) * lame.mu),
        l_(lame.lambda + (1 - c_ / 6) * lame.mu),
        a_(1 + (1 - c_ / 4) * m_ / l_) {}

  double c_, m_, l_, a_;
};

}  // namespace stroma
