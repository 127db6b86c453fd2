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
  points_.set(all ? allIndices(state().size()) : points->indices);
  stiffness_ = stiffness;
  if (stiffness_.size() == 1) stiffness_.assign(points_.size(), stiffness_.front());
  if (stiffness_.size() != points_.size()) {
    error(stiffness, "value-count",
          "has " + std::to_string(stiffness_.size()) + " values for " +
              std::to_string(points_.size()) + " points",
          "give one value, or one for each point");
  }
}

void RestShapeSpringsForceField::topologyChanged(const TopologyChange& change) {
  if (&change.nodes == &state()) points_.follow(change, [](std::size_t) {});
}

void RestShapeSpringsForceField::topologyRestored() { points_.restore(); }

void RestShapeSpringsForceField::addForce(const StateView& at, Vec3Span f) {
  const ConstVec3Span rest = state().rest();
  parallelFor(static_cast<Index>(points_.size()), [&](Index n) {
    const auto k = static_cast<std::size_t>(n);
    const std::size_t i = points_.node(k);
    f[i] += stiffnessAt(k) * (rest[i] - at.x[i]);
  });
}

double RestShapeSpringsForceField::potentialEnergy(const StateView& at) const {
  const ConstVec3Span rest = state().rest();
  double energy = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::size_t i = points_.node(k);
    energy += 0.5 * stiffnessAt(k) * (at.x[i] - rest[i]).squaredNorm();
  }
  return energy;
}

void RestShapeSpringsForceField::addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double,
                                                   Vec3Span df) const {
  parallelFor(static_cast<Index>(points_.size()), [&](Index n) {
    const auto k = static_cast<std::size_t>(n);
    df[points_.node(k)] -= stiffnessFactor * stiffnessAt(k) * dx[points_.node(k)];
  });
}

void RestShapeSpringsForceField::addTangent(BlockMatrix& matrix, Index offset,
                                            double stiffnessFactor, double) const {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    matrix.addDiagonal(offset + points_.nodes()[k], -stiffnessFactor * stiffnessAt(k));
  }
}

}  // namespace stroma
