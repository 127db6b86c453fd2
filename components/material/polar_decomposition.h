// SPDX-License-Identifier: Apache-2.0
// Closest proper rotation to a matrix: R maximises tr(R^T F) with det R = +1 for every finite F,
// inverted and singular ones included (where several rotations are equally close, one of them).
// Method: the unit quaternion of R is the dominant eigenvector of Horn's symmetric 4x4 matrix
// (Horn 1987). Its eigenvalue is found by Newton's method on the quartic from above, where the
// convergence is monotone, and one Newton step on the rotation itself removes the rounding of the
// quartic. Near a double root (F close to a reflection or of rank one) the eigenproblem is solved
// by Jacobi rotations instead.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "components/material/symmetric_eigen.h"

namespace stroma {

namespace detail {

inline Eigen::Matrix4d hornMatrix(const Mat3& F) {
  const Vec3 axial(F(2, 1) - F(1, 2), F(0, 2) - F(2, 0), F(1, 0) - F(0, 1));
  Eigen::Matrix4d N;
  N(0, 0) = F.trace();
  N.block<3, 1>(1, 0) = axial;
  N.block<1, 3>(0, 1) = axial.transpose();
  N.block<3, 3>(1, 1) = F + F.transpose() - F.trace() * Mat3::Identity();
  return N;
}

// Largest root of det(N - r I), whose coefficients follow from |F|^2, det F and det N.
inline double dominantRoot(const Mat3& F, const Eigen::Matrix4d& N) {
  const double c2 = -2 * F.squaredNorm(), c1 = -8 * F.determinant(), c0 = N.determinant();
  double root = std::sqrt(3 * F.squaredNorm());
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double value = ((root * root + c2) * root + c1) * root + c0;
    const double slope = (4 * root * root + 2 * c2) * root + c1;
    const double step = slope > 0 ? value / slope : 0;
    root -= step;
    if (!(std::abs(step) > 1e-14 * root)) break;
  }
  return root;
}

inline double cofactor(const Eigen::Matrix4d& A, int row, int column) {
  Mat3 minor;
  for (int i = 0, r = 0; i < 4; ++i) {
    if (i == row) continue;
    for (int j = 0, c = 0; j < 4; ++j)
      if (j != column) minor(r, c++) = A(i, j);
    ++r;
  }
  return ((row + column) % 2 ? -1 : 1) * minor.determinant();
}

// Unit eigenvector from the adjugate; false where the root is (nearly) double.
inline bool eigenvectorFromAdjugate(const Eigen::Matrix4d& A, double scale, Eigen::Vector4d& q) {
  int best = 0;
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    const double diagonal = std::abs(cofactor(A, i, i));
    if (diagonal > largest) largest = diagonal, best = i;
  }
  if (!(largest > 1e-5 * scale * scale * scale)) return false;
  for (int j = 0; j < 4; ++j) q[j] = j == best ? 0 : cofactor(A, best, j);
  q[best] = cofactor(A, best, best);
  q.normalize();
  return true;
}

inline Mat3 toRotation(const Eigen::Vector4d& q) {
  return Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

}  // namespace detail

// Axial vector of A - A^T.
inline Vec3 axialVector(const Mat3& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

[[nodiscard]] inline Mat3 closestRotation(const Mat3& F) {
  const double scale = F.norm();
  if (!(scale > 1e-150)) return Mat3::Identity();
  const Mat3 G = F / scale;
  const Eigen::Matrix4d N = detail::hornMatrix(G);
  Eigen::Vector4d q;
  const double root = detail::dominantRoot(G, N);
  if (!detail::eigenvectorFromAdjugate(N - root * Eigen::Matrix4d::Identity(), 1, q)) {
    q = symmetricEigen<4>(N).vectors.col(3);
    return detail::toRotation(q);
  }
  // one Newton step: the rotation w of the body frame that makes R^T G symmetric
  const Mat3 S = detail::toRotation(q).transpose() * G;
  const Mat3 K = S.trace() * Mat3::Identity() - 0.5 * (S + S.transpose());
  const Vec3 w = K.inverse() * axialVector(S);
  if (w.squaredNorm() < 0.01) {
    const Quat turned =
        Quat(q[0], q[1], q[2], q[3]) * Quat(1, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z()).normalized();
    return turned.normalized().toRotationMatrix();
  }
  return detail::toRotation(q);
}

// F = U diag(sigma) V^T with U, V proper rotations; at most the smallest |sigma| is negative.
struct PrincipalFrame {
  Mat3 U, V;
  Vec3 sigma;
};

[[nodiscard]] inline PrincipalFrame principalFrame(const Mat3& F) {
  const Mat3 R = closestRotation(F);
  const Mat3 S = R.transpose() * F;
  const SymmetricEigen<3> eigen = symmetricEigen<3>(0.5 * (S + S.transpose()));
  Mat3 V = eigen.vectors;
  if (V.determinant() < 0) V.col(0) = -V.col(0);
  return {R * V, V, eigen.values};
}

}  // namespace stroma
