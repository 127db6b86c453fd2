// SPDX-License-Identifier: Apache-2.0
// Hooke's law with the corotated strain R^T F - I, F = R S the polar decomposition, det R = +1:
//   psi = mu |F - R|^2 + lambda/2 tr(S - I)^2,  P = 2 mu (F - R) + lambda tr(S - I) R.
// Any rotation, linear in strain. The exact R keeps linear and angular momentum. Its derivative is
// dR = R [w], (tr(S) I - S) w = axial(R^T dF); the only modes that can lose stability are the three
// twists, with the value mu + (lambda tr(S - I) - 2 mu)/(sigma_i + sigma_j) (Kim, Eberle 2020),
// which the filtered tangent clamps at zero. Units: Pa, J/m^3.
#pragma once

#include <algorithm>

#include "components/material/lame.h"
#include "components/material/polar_decomposition.h"

namespace stroma {

class HookeCorotated {
 public:
  struct Tangent {
    Mat3 R;
    Mat3 turning;  // maps the axial vector of R^T dF to that of R^T dP, beyond 2 mu dF
  };
  // Its own type, so that a caller cannot mistake one for the other.
  struct FilteredTangent : Tangent {};

  HookeCorotated(double youngModulus, double poissonRatio) : lame_(youngModulus, poissonRatio) {}

  [[nodiscard]] double energy(const Mat3& F) const {
    const Mat3 R = closestRotation(F);
    const double trace = stretchTrace(R, F);
    return lame_.mu * (F - R).squaredNorm() + 0.5 * lame_.lambda * trace * trace;
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const {
    const Mat3 R = closestRotation(F);
    return 2 * lame_.mu * (F - R) + lame_.lambda * stretchTrace(R, F) * R;
  }
  [[nodiscard]] Tangent tangent(const Mat3& F) const { return prepare(F, false); }
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const { return {prepare(F, true)}; }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    const Mat3 A = t.R.transpose() * dF;
    return 2 * lame_.mu * dF + t.R * (lame_.lambda * A.trace() * Mat3::Identity() +
                                      skewMatrix(t.turning * axialVector(A)));
  }

 private:
  static double stretchTrace(const Mat3& R, const Mat3& F) { return R.cwiseProduct(F).sum() - 3; }

  Tangent prepare(const Mat3& F, bool filtered) const {
    const Mat3 R = closestRotation(F);
    const Mat3 S = R.transpose() * F;
    const SymmetricEigen<3> eigen = symmetricEigen<3>(0.5 * (S + S.transpose()));
    const Vec3& sigma = eigen.values;
    const double factor = lame_.lambda * (sigma.sum() - 3) - 2 * lame_.mu;
    Vec3 values;
    for (int k = 0; k < 3; ++k) {
      // the closest rotation makes every pair sum non-negative; zero means that R is not unique
      const double pair = std::max(sigma.sum() - sigma[k], 1e-8);
      values[k] = filtered ? std::max(factor / pair, -lame_.mu) : factor / pair;
    }
    const Mat3& Q = eigen.vectors;
    return {R, Q * values.asDiagonal() * Q.transpose()};
  }

  Lame lame_;
};

}  // namespace stroma
