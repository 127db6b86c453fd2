// SPDX-License-Identifier: Apache-2.0
// Where a point of the deformed body was at rest: the inverse of the moving-least-squares motion
//   x(X) = x_m + F (X - X_m),
// x_m, X_m and F the weighted means and the weighted affine fit of the particles within `reach` of
// X, found by X <- X + F^-1 (x - x(X)). Cuts are not seen: in the gap of an open incision the point
// falls between its walls.
#pragma once

#include <optional>

#include "components/cutting/hash_grid.h"

namespace stroma {

class RestPlacement {
 public:
  struct Place {
    Vec3 rest;     // m
    Mat3 inverse;  // F^-1
  };

  // `reach`: how far away particles count [m]; about two spacings.
  RestPlacement(ConstVec3Span rest, double reach);

  // Nothing where no particles are around: then the point is outside the body, by more than about
  // the reach; or where the motion is too wild to be inverted to a twentieth of the reach. `guess`:
  // a rest position near the answer.
  [[nodiscard]] std::optional<Place> find(const Vec3& point, const Vec3& guess,
                                          ConstVec3Span x) const;
  // Particles within the reach of a rest position, ascending.
  [[nodiscard]] std::vector<Index> around(const Vec3& rest) const;
  [[nodiscard]] double reach() const { return reach_; }
  // Suits the cloud: half more than the distance of the eighth neighbour, median of some particles.
  [[nodiscard]] static double reachOf(ConstVec3Span rest);

 private:
  [[nodiscard]] bool fit(const Vec3& at, ConstVec3Span x, Vec3& image, Mat3& F) const;

  std::vector<Vec3> rest_;
  double reach_;
  HashGrid grid_;
};

}  // namespace stroma
