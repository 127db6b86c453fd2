// SPDX-License-Identifier: Apache-2.0
// Hooke's law with Cauchy's infinitesimal strain e = (F + F^T)/2 - I (linear elasticity):
//   psi = mu e:e + lambda/2 tr(e)^2,  P = 2 mu e + lambda tr(e) I.
// Valid for small rotations only: a rotated body is strained and pushed. Units: Pa, J/m^3.
#pragma once

#include "components/material/lame.h"
#include "core/types.h"

namespace stroma {

class HookeCauchy {
 public:
  struct Tangent {};
  using FilteredTangent = Tangent;

  HookeCauchy(double youngModulus, double poissonRatio) : lame_(youngModulus, poissonRatio) {}

  [[nodiscard]] double energy(const Mat3& F) const {
    const Mat3 e = strain(F);
    return lame_.mu * e.squaredNorm() + 0.5 * lame_.lambda * e.trace() * e.trace();
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const { return hooke(strain(F)); }

  // The same stress for the inner loops: columns of F as registers of at least three lanes.
  template <class Lanes>
  void stressColumns(const Lanes& f0, const Lanes& f1, const Lanes& f2, Lanes& p0, Lanes& p1,
                     Lanes& p2) const {
    const double mu2 = 2 * lame_.mu, trace = f0[0] + f1[1] + f2[2] - 3;
    const double all = lame_.lambda * trace - mu2;
    const double s01 = lame_.mu * (f0[1] + f1[0]), s12 = lame_.mu * (f1[2] + f2[1]);
    const double s02 = lame_.mu * (f0[2] + f2[0]);
    p0 = Lanes{mu2 * f0[0] + all, s01, s02};
    p1 = Lanes{s01, mu2 * f1[1] + all, s12};
    p2 = Lanes{s02, s12, mu2 * f2[2] + all};
  }

  [[nodiscard]] Tangent tangent(const Mat3&) const { return {}; }
  // The law is convex, so the filtered tangent is the tangent.
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3&) const { return {}; }
  [[nodiscard]] Mat3 dStress(const Tangent&, const Mat3& dF) const {
    return hooke(0.5 * (dF + dF.transpose()));
  }

 private:
  static Mat3 strain(const Mat3& F) { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }
  Mat3 hooke(const Mat3& e) const {
    return 2 * lame_.mu * e + lame_.lambda * e.trace() * Mat3::Identity();
  }

  Lame lame_;
};

}  // namespace stroma
