// SPDX-License-Identifier: Apache-2.0
// Eigenvalues (ascending) and eigenvectors of a small symmetric matrix by cyclic Jacobi rotations:
// accurate to rounding also for clustered and for zero eigenvalues.
#pragma once

#include <cmath>
#include <utility>

#include "core/types.h"

namespace stroma {

template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;  // columns
};

template <int N>
[[nodiscard]] SymmetricEigen<N> symmetricEigen(Eigen::Matrix<double, N, N> A) {
  Eigen::Matrix<double, N, N> V = Eigen::Matrix<double, N, N>::Identity();
  constexpr int maxSweeps = 30;
  for (int sweep = 0; sweep < maxSweeps; ++sweep) {
    double off = 0, all = 0;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) (i == j ? all : off) += A(i, j) * A(i, j);
    if (!(off > 1e-34 * all)) break;
    for (int p = 0; p < N - 1; ++p)
      for (int q = p + 1; q < N; ++q) {
        if (A(p, q) == 0) continue;
        // the smaller root of t^2 + 2 t theta - 1 = 0 zeroes A(p, q)
        const double theta = (A(q, q) - A(p, p)) / (2 * A(p, q));
        const double t =
            std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < N; ++k) {
          const double kp = A(k, p), kq = A(k, q);
          A(k, p) = c * kp - s * kq;
          A(k, q) = s * kp + c * kq;
        }
        for (int k = 0; k < N; ++k) {
          const double pk = A(p, k), qk = A(q, k), vp = V(k, p), vq = V(k, q);
          A(p, k) = c * pk - s * qk;
          A(q, k) = s * pk + c * qk;
          V(k, p) = c * vp - s * vq;
          V(k, q) = s * vp + c * vq;
        }
        A(p, q) = A(q, p) = 0;  // what rounding leaves there would keep the sweeps going
      }
  }
  SymmetricEigen<N> out{A.diagonal(), V};
  for (int i = 0; i < N - 1; ++i)
    for (int j = i + 1; j < N; ++j)
      if (out.values[j] < out.values[i]) {
        std::swap(out.values[i], out.values[j]);
        out.vectors.col(i).swap(out.vectors.col(j));
      }
  return out;
}

}  // namespace stroma
