// SPDX-License-Identifier: Apache-2.0
// Lame parameters of an isotropic elastic solid, in pascal, from Young's modulus (Pa, > 0) and
// Poisson's ratio (-1 < nu < 0.5). Throws std::invalid_argument outside these ranges.
#pragma once

#include <stdexcept>

namespace stroma {

struct Lame {
  double mu;      // shear modulus
  double lambda;  // first parameter

  Lame(double youngModulus, double poissonRatio)
      : mu(youngModulus / (2 * (1 + poissonRatio))),
        lambda(youngModulus * poissonRatio / ((1 + poissonRatio) * (1 - 2 * poissonRatio))) {
    if (!(youngModulus > 0)) throw std::invalid_argument("youngModulus must be positive");
    if (!(poissonRatio > -1 && poissonRatio < 0.5))
      throw std::invalid_argument("poissonRatio must lie between -1 and 0.5, both excluded");
  }
};

}  // namespace stroma
