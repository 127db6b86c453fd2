// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/volume_constraint.h"

#include "components/material/volume_penalty.h"
#include "components/mechanics/mls_elasticity.h"

namespace stroma {

struct VolumeConstraint::Loops {
  MlsElasticity<VolumePenalty> elasticity;
};

VolumeConstraint::VolumeConstraint() = default;
VolumeConstraint::~VolumeConstraint() = default;

void VolumeConstraint::bind() {
  loops_ = std::make_unique<Loops>(
      Loops{MlsElasticity<VolumePenalty>(VolumePenalty(stiffness), forceField->bonds(), false)});
  forceField->countEnergyOf([this](ConstVec3Span x, std::span<const Index> particles) {
    return loops_->elasticity.energyOf(x, particles);
  });
}

void VolumeConstraint::attributeChanged(const AttributeBase&) {
  loops_->elasticity.setMaterial(VolumePenalty(stiffness));
}

void VolumeConstraint::addForce(const StateView& at, Vec3Span f) {
  loops_->elasticity.addForces(at.x, f);
}

double VolumeConstraint::potentialEnergy(const StateView& at) const {
  return loops_->elasticity.energy(at.x);
}

void VolumeConstraint::linearize(const StateView& at) {
  loops_->elasticity.prepareTangent(at.x, forceField->tangent);
}

void VolumeConstraint::addTangentProduct(ConstVec3Span dx, double stiffnessFactor,
                                         double /*dampingFactor*/, Vec3Span df) const {
  if (stiffnessFactor != 0) loops_->elasticity.addStiffnessProduct(-stiffnessFactor, dx, df);
}

bool VolumeConstraint::addPattern(BlockPattern& pattern, Index offset) const {
  return forceField->addPattern(pattern, offset);
}

void VolumeConstraint::addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                                  double /*dampingFactor*/) const {
  loops_->elasticity.assembleStiffness([&](Index row, Index column, const Mat3& block) {
    matrix.add(offset + row, offset + column, -stiffnessFactor * block);
  });
}

}  // namespace stroma
