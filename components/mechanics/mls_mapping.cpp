// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_mapping.h"

namespace stroma {

void MLSMapping::bind() {
  if (&forceField->state() != in.get()) {
    error(forceField, "mapping-force-field",
          "acts on '" + forceField->state().path() + "', but the input is '" + in->path() + "'");
    return;
  }
  const Index supports = supportCount > 0 ? *supportCount : *forceField->surfaceSupport;
  const auto triangles = surface ? surface->triangles() : std::span<const Triangle>{};
  shape_ = forceField->shapeOf(out->rest(), triangles, supports);
}

void MLSMapping::apply(ConstVec3Span particles, Vec3Span points) const {
  shape_->apply(particles, points);
}

void MLSMapping::applyJ(ConstVec3Span particles, Vec3Span points) const {
  shape_->apply(particles, points);
}

void MLSMapping::addTransposed(ConstVec3Span points, Vec3Span particles) const {
  shape_->addTransposed(points, particles);
}

}  // namespace stroma
