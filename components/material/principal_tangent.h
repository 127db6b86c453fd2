// SPDX-License-Identifier: Apache-2.0
// Derivative of the stress of an isotropic law psi(sigma1, sigma2, sigma3), and its positive
// semi-definite projection, in the frame of the principal stretches. There the 9x9 operator falls
// apart into one 3x3 block on the diagonal and, for every pair (i, j), a twist and a flip mode
// (Smith, de Goes, Kim 2018 and 2019; Kim, Eberle 2020), so that the projection is exact and costs
// one 3x3 eigenproblem.
#pragma once

#include "components/material/polar_decomposition.h"

namespace stroma {

struct PrincipalTangent {
  Mat3 U, V;   // F = U diag(sigma) V^T
  Mat3 scale;  // d2 psi / d sigma_i d sigma_j
  Vec3 twist;  // (psi_i + psi_j) / (sigma_i + sigma_j), entry k belongs to the pair without k
  Vec3 flip;   // (psi_i - psi_j) / (sigma_i - sigma_j)

  void projectPositive() {
    const SymmetricEigen<3> eigen = symmetricEigen<3>(scale);
    scale = eigen.vectors * eigen.values.cwiseMax(0).asDiagonal() * eigen.vectors.transpose();
    twist = twist.cwiseMax(0);
    flip = flip.cwiseMax(0);
  }

  [[nodiscard]] Mat3 apply(const Mat3& dF) const {
    const Mat3 D = U.transpose() * dF * V;
    const Vec3 diagonal = scale * D.diagonal();
    Mat3 R;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double even = 0.5 * flip[k] * (D(i, j) + D(j, i));
      const double odd = 0.5 * twist[k] * (D(i, j) - D(j, i));
      R(k, k) = diagonal[k];
      R(i, j) = even + odd;
      R(j, i) = even - odd;
    }
    return U * R * V.transpose();
  }
};

}  // namespace stroma
