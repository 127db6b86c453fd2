// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/rest_shape_springs.h"

#include "components/boundary/index_check.h"
#include "core/parallel.h"

namespace stroma {

void RestShapeSpringsForceField::configure() {
  if (points.isSet() == all) {
    error("attr-required", "needs either 'points' or all=\"true\"",
          "an elastic support of every particle is rarely meant, so it must be said");
  }
}

void RestShapeSpringsForceField::bind() {
  if (!checkIndices(*this, points, state())) return;
  point_ = all ? allIndices(state().size()) : points->indices;
  stiffness_ = stiffness;
  if (stiffness_.size() == 1) stiffness_.assign(point_.size(), stiffness_.front());
  if (stiffness_.size() != point_.size()) {
    error(stiffness, "value-count",
          "has " + std::to_string(stiffness_.size()) + " values for " +
              std::to_string(point_.size()) + " points",
          "give one value, or one for each point");
  }
}

void RestShapeSpringsForceField::addForce(const StateView& at, Vec3Span f) {
  const ConstVec3Span rest = state().rest();
  parallelFor(static_cast<Index>(point_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(point_[static_cast<std::size_t>(k)]);
    f[i] += stiffness_[static_cast<std::size_t>(k)] * (rest[i] - at.x[i]);
  });
}

double RestShapeSpringsForceField::potentialEnergy(const StateView& at) const {
  const ConstVec3Span rest = state().rest();
  double energy = 0;
  for (std::size_t k = 0; k < point_.size(); ++k) {
    const auto i = static_cast<std::size_t>(point_[k]);
    energy += 0.5 * stiffness_[k] * (at.x[i] - rest[i]).squaredNorm();
  }
  return energy;
}

void RestShapeSpringsForceField::addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double,
                                                   Vec3Span df) const {
  parallelFor(static_cast<Index>(point_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(point_[static_cast<std::size_t>(k)]);
    df[i] -= stiffnessFactor * stiffness_[static_cast<std::size_t>(k)] * dx[i];
  });
}

void RestShapeSpringsForceField::addTangent(BlockMatrix& matrix, Index offset,
                                            double stiffnessFactor, double) const {
  for (std::size_t k = 0; k < point_.size(); ++k) {
    matrix.addDiagonal(offset + point_[k], -stiffnessFactor * stiffness_[k]);
  }
}

}  // namespace stroma
