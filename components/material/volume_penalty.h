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
  // The same, added to what the columns hold: F as registers of at least three lanes.
  template <class Lanes>
  void addStressColumns(const Lanes& f0, const Lanes& f1, const Lanes& f2, Lanes& p0, Lanes& p1,
                        Lanes& p2) const {
    const auto cross = [](const Lanes& a, const Lanes& b) {
      return Lanes{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Lanes c0 = cross(f1, f2), m = f0 * c0;
    const double pressure = k_ * (m[0] + m[1] + m[2] - 1);
    p0 += pressure * c0;
    p1 += pressure * cross(f2, f0);
    p2 += pressure * cross(f0, f1);
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

// A law and the penalty, evaluated together.
template <class Law>
class WithVolumePenalty {
 public:
  struct Tangent {
    typename Law::Tangent law;
    VolumePenalty::Tangent penalty;
  };
  struct FilteredTangent {
    typename Law::FilteredTangent law;
    VolumePenalty::FilteredTangent penalty;
  };

  WithVolumePenalty(const Law& law, const VolumePenalty& penalty) : law_(law), penalty_(penalty) {}

  [[nodiscard]] double energy(const Mat3& F) const { return law_.energy(F) + penalty_.energy(F); }
  [[nodiscard]] Mat3 stress(const Mat3& F) const { return law_.stress(F) + penalty_.stress(F); }
  // With the closest rotation R, where the law can be told it.
  [[nodiscard]] Mat3 stress(const Mat3& F, const Mat3& R) const requires requires(const Law& law) {
    law.stress(F, R);
  }
  { return law_.stress(F, R) + penalty_.stress(F); }
  template <class Lanes>
  requires requires(const Law& law, Lanes v) { law.stressColumns(v, v, v, v, v, v); }
  void stressColumns(const Lanes& f0, const Lanes& f1, const Lanes& f2, Lanes& p0, Lanes& p1,
                     Lanes& p2) const {
    law_.stressColumns(f0, f1, f2, p0, p1, p2);
    penalty_.addStressColumns(f0, f1, f2, p0, p1, p2);
  }
  [[nodiscard]] Tangent tangent(const Mat3& F) const {
    return {law_.tangent(F), penalty_.tangent(F)};
  }
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    return {law_.filteredTangent(F), penalty_.filteredTangent(F)};
  }
  template <class T>
  [[nodiscard]] Mat3 dStress(const T& t, const Mat3& dF) const {
    return law_.dStress(t.law, dF) + penalty_.dStress(t.penalty, dF);
  }

 private:
  Law law_;
  VolumePenalty penalty_;
};

}  // namespace stroma
