// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/fixed_constraints.h"

#include "components/boundary/index_check.h"

namespace stroma {
namespace {

// Shared by the two constraints that hold a list of particles or all of them.
void requireParticles(Component& component, const Attribute<IndexList>& indices,
                      const Attribute<bool>& fixAll) {
  if (!indices.isSet() && !fixAll) {
    component.error("attr-required", "does not say which particles it holds",
                    "give 'indices', or fixAll=\"true\" (no particle is held by default)");
  } else if (indices.isSet() && fixAll) {
    component.error(fixAll, "attr-conflict", "holds every particle, so 'indices' has no meaning");
  }
}

void addSame(const std::vector<Index>& held, const Mat3& projector,
             std::vector<ParticleProjector>& projectors) {
  for (const Index i : held) projectors.push_back({i, projector});
}

}  // namespace

void FixedProjectiveConstraint::configure() { requireParticles(*this, indices, fixAll); }

void FixedProjectiveConstraint::bind() {
  if (!checkIndices(*this, indices, state())) return;
  held_ = fixAll ? allIndices(state().size()) : indices->indices;
}

void FixedProjectiveConstraint::addProjectors(std::vector<ParticleProjector>& projectors) const {
  addSame(held_, Mat3::Zero(), projectors);
}

void PartialFixedProjectiveConstraint::configure() {
  requireParticles(*this, indices, fixAll);
  if (fixedDirections->size() != 3) {
    error(fixedDirections, "value-count",
          "has " + std::to_string(fixedDirections->size()) + " values, expected 3: x y z");
  }
}

void PartialFixedProjectiveConstraint::bind() {
  if (!checkIndices(*this, indices, state())) return;
  held_ = fixAll ? allIndices(state().size()) : indices->indices;
}

void PartialFixedProjectiveConstraint::addProjectors(
    std::vector<ParticleProjector>& projectors) const {
  Mat3 projector = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    projector(axis, axis) = 1 - (*fixedDirections)[static_cast<std::size_t>(axis)];
  }
  addSame(held_, projector, projectors);
}

void FixedPlaneProjectiveConstraint::configure() {
  if (direction->norm() == 0) {
    error(direction, "value-range", "is the zero vector: a plane needs a normal");
  }
  const bool slab = dmin.isSet() && dmax.isSet();
  if (slab == indices.isSet() || dmin.isSet() != dmax.isSet()) {
    error("attr-required", "needs either 'dmin' and 'dmax', or 'indices'");
  } else if (slab && dmin > dmax) {
    error(dmax, "value-range", "is less than 'dmin'");
  }
}

void FixedPlaneProjectiveConstraint::bind() {
  if (!checkIndices(*this, indices, state())) return;
  held_ = indices->indices;
  if (indices.isSet()) return;
  const Vec3 normal = direction->normalized();
  for (Index i = 0; i < state().size(); ++i) {
    const double d = state().rest()[static_cast<std::size_t>(i)].dot(normal);
    if (d >= dmin && d <= dmax) held_.push_back(i);
  }
  if (held_.empty()) warning("index-empty", "holds no particle: none lies between dmin and dmax");
}

void FixedPlaneProjectiveConstraint::addProjectors(
    std::vector<ParticleProjector>& projectors) const {
  const Vec3 normal = direction->normalized();
  addSame(held_, Mat3::Identity() - normal * normal.transpose(), projectors);
}

}  // namespace stroma
