// SPDX-License-Identifier: Apache-2.0
// Radial weights of moving least squares, w(q) for q = distance / support radius in [0, 1], w(0) =
// 1 and w(1) = 0. Constant factors cancel in the gradients, so none is kept.
#pragma once

namespace stroma {

enum class Kernel {
  mueller2003,   // (1 - q^2)^3, the "poly6" shape
  wendland1995,  // (1 - q)^4 (4 q + 1), C2
  desbrun1996    // (1 - q)^3, "spiky"
};

[[nodiscard]] inline double kernelWeight(Kernel kernel, double q) {
  const double r = 1 - q;
  if (!(r > 0)) return 0;
  switch (kernel) {
    case Kernel::wendland1995:
      return r * r * r * r * (4 * q + 1);
    case Kernel::desbrun1996:
      return r * r * r;
    case Kernel::mueller2003:
      break;
  }
  const double s = 1 - q * q;
  return s * s * s;
}

}  // namespace stroma
