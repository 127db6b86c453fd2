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
  [[nodiscard]] Mat3 stress(const Mat3& F) const { return stress(F, closestRotation(F)); }
  [[nodiscard]] Tangent tangent(const Mat3& F) const { return tangent(F, closestRotation(F)); }
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F) const {
    return filteredTangent(F, closestRotation(F));
  }

  // The same for loops that find the closest rotations R of many F at once.
  [[nodiscard]] Mat3 stress(const Mat3& F, const Mat3& R) const {
    return 2 * lame_.mu * (F - R) + lame_.lambda * stretchTrace(R, F) * R;
  }
  [[nodiscard]] Tangent tangent(const Mat3& F, const Mat3& R) const { return prepare(F, R, false); }
  [[nodiscard]] FilteredTangent filteredTangent(const Mat3& F, const Mat3& R) const {
    return {prepare(F, R, true)};
  }
  [[nodiscard]] Mat3 dStress(const Tangent& t, const Mat3& dF) const {
    // A = R^T dF enters by its trace and its axial vector alone
    const Mat3& R = t.R;
    const Vec3 axial(R.col(2).dot(dF.col(1)) - R.col(1).dot(dF.col(2)),
                     R.col(0).dot(dF.col(2)) - R.col(2).dot(dF.col(0)),
                     R.col(1).dot(dF.col(0)) - R.col(0).dot(dF.col(1)));
    const Vec3 w = t.turning * axial;
    Mat3 dP = 2 * lame_.mu * dF + lame_.lambda * R.cwiseProduct(dF).sum() * R;
    // R [w]
    dP.col(0) += w.z() * R.col(1) - w.y() * R.col(2);
    dP.col(1) += w.x() * R.col(2) - w.z() * R.col(0);
    dP.col(2) += w.y() * R.col(0) - w.x() * R.col(1);
    return dP;
  }

 private:
  static double stretchTrace(const Mat3& R, const Mat3& F) { return R.cwiseProduct(F).sum() - 3; }

  // By leading minors (Sylvester).
  static bool isPositive(const Mat3& A) {
    return A(0, 0) > 0 && A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) > 0 && A.determinant() > 0;
  }

  Tangent prepare(const Mat3& F, const Mat3& R, bool filtered) const {
    const Mat3 A = R.transpose() * F, S = 0.5 * (A + A.transpose());
    const double factor = lame_.lambda * (S.trace() - 3) - 2 * lame_.mu;
    // Its eigenvalues are the sums of two stretches. Where all of them are clamped, or none, their
    // vectors are not needed.
    const Mat3 pairs = S.trace() * Mat3::Identity() - S;
    constexpr double wellAboveZero = 0.01;
    if (isPositive(pairs - wellAboveZero * Mat3::Identity())) {
      const Mat3 margin = lame_.mu * pairs + factor * Mat3::Identity();
      if (!filtered || isPositive(margin)) return {R, factor * pairs.inverse()};
      if (isPositive(-margin)) return {R, -lame_.mu * Mat3::Identity()};
    }
    const SymmetricEigen<3> eigen = symmetricEigen<3>(S);
    const Vec3& sigma = eigen.values;
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
