// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/velocity_damping.h"

#include "core/parallel.h"

namespace stroma {
namespace {

void addScaled(ConstVec3Span a, double factor, Vec3Span sum) {
  if (factor == 0) return;
  parallelFor(static_cast<Index>(a.size()), [&](Index n) {
    const auto i = static_cast<std::size_t>(n);
    sum[i] += factor * a[i];
  });
}

}  // namespace

void UniformVelocityDampingForceField::addForce(const StateView& at, Vec3Span f) {
  addScaled(at.v, -dampingCoefficient.value(), f);
}

void UniformVelocityDampingForceField::addTangentProduct(ConstVec3Span dx, double, double damping,
                                                         Vec3Span df) const {
  addScaled(dx, -damping * dampingCoefficient.value(), df);
}

void UniformVelocityDampingForceField::addTangent(BlockMatrix& matrix, Index offset, double,
                                                  double damping) const {
  for (Index i = 0; i < state().size(); ++i) {
    matrix.addDiagonal(offset + i, -damping * dampingCoefficient.value());
  }
}

}  // namespace stroma
