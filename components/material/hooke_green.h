// SPDX-License-Identifier: Apache-2.0
// Hooke's law with Green's strain E = (F^T F - I)/2 (St. Venant-Kirchhoff):
//   psi = mu E:E + lambda/2 tr(E)^2,  P = F S,  S = 2 mu E + lambda tr(E) I.
// Any rotation, moderate strain: a bar under compression has its largest load at the stretch 0.577
// and collapses beyond. Units: Pa, J/m^3.
#pragma once

#include "components/material/lame.h"
#include "components/material/principal_tangent.h"

namespace stroma {

class HookeGreen {
 public:
  struct Tangent {
    Mat3 F, S;
  };
  using FilteredTangent = PrincipalTangent;

  HookeGreen(double youngModulus, double poissonRatio) : lame_(youngModulus, poissonRatio) {}

  [[nodiscard]] double energy(const Mat3& F) const {
    const Mat3 E = strain(F);
    return lame_.mu * E.squaredNorm() + 0.5 * lame_.lambda * E.trace() * E.trace();
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const { return F * hooke(strain(F)); }

  // The same stress for the inner loops: columns of F as registers of at least three lanes.
  template <class Lanes>
  void stressColumns(const Lanes& f0, const Lanes& f1, const Lanes& f2, Lanes& p0, Lanes& p1,
                     Lanes& p2) const {
    const auto dot = [](const Lanes& a, const Lanes& b) {
      const Lanes m = a * b;
      return m[0] + m[1] + m[2];
    };
    const double e00 = 0.5 * (dot(f0, f0) - 1), e11 = 0.5 * (dot(f1, f1) - 1);
    const double e22 = 0.5 * (dot(f2, f2) - 1);
    const double mu2 = 2 * lame_.mu, pressure = lame_.lambda * (e00 + e11 + e22);
    const double s00 = mu2 * e00 + pressure, s11 = mu2 * e11 + pressure;
    const double s22 = mu2 * e22 + pressure;
    const double s01 = lame_.mu * dot(f0, f1), s12 = lame_.mu * dot(f1, f2);
    const double s02 = lame_.mu * dot(f0, f2);
    p0 = f0 * s00 + f1 * s01 + f2 * s02;
    p1 = f0 * s01 + f1 * s11 + f2 * s12;
    p2 = f0 * s02 + f1 * s12 + f2 * s22;
  }

  [[nodiscard]] Tangent tangent(const Mat3& F) const { return {F, hooke(strain(F))}; }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    const Mat3 A = t.F.transpose() * dF;
    return dF * t.S + t.F * hooke(0.5 * (A + A.transpose()));
  }

  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    const PrincipalFrame frame = principalFrame(F);
    const Vec3& s = frame.sigma;
    const double mu = lame_.mu, lambda = lame_.lambda;
    const double pressure = 0.5 * lambda * (s.squaredNorm() - 3);
    PrincipalTangent t{frame.U, frame.V, lambda * s * s.transpose(), {}, {}};
    for (int k = 0; k < 3; ++k) {
      const double si = s[(k + 1) % 3], sj = s[(k + 2) % 3];
      t.scale(k, k) += pressure + mu * (3 * s[k] * s[k] - 1);
      t.twist[k] = pressure + mu * (si * si - si * sj + sj * sj - 1);
      t.flip[k] = pressure + mu * (si * si + si * sj + sj * sj - 1);
    }
    t.projectPositive();
    return t;
  }
  [[nodiscard]] Mat3 dStress(const FilteredTangent& t, const Mat3& dF) const { return t.apply(dF); }

 private:
  static Mat3 strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }
  Mat3 hooke(const Mat3& E) const {
    return 2 * lame_.mu * E + lame_.lambda * E.trace() * Mat3::Identity();
  }

  Lame lame_;
};

}  // namespace stroma
