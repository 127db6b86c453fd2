// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/traction_force_field.h"

#include "components/boundary/ramp.h"

namespace stroma {

void TractionForceField::configure() {
  if (traction.isSet() == stress.isSet()) {
    error("attr-required", "needs one of 'traction' and 'stress'");
  } else if (stress.isSet() && !stress.source() && stress->size() != 6) {
    error(stress, "value-count",
          "has " + std::to_string(stress->size()) + " values, expected 6: xx yy zz xy yz zx");
  }
}

void TractionForceField::bind() {
  if (!surface_.select(*this, state(), topology.get(), triangles, triangleIndices)) return;
  if (stress.isSet()) {
    const std::vector<double>& s = stress;
    if (s.size() != 6) {
      error(stress, "value-count", "has " + std::to_string(s.size()) + " numbers, expected 6");
      return;
    }
    tensor_ << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  }
  computeForces();
}

void TractionForceField::computeForces() {
  force_.resize(surface_.nodes().size());
  for (std::size_t n = 0; n < force_.size(); ++n) force_[n] = fullForce(static_cast<Index>(n));
}

Vec3 TractionForceField::fullForce(Index place) const {
  Vec3 force = Vec3::Zero();
  surface_.forCorners(place, [&](Index triangle, Index) {
    const Triangle& t = surface_.triangles()[static_cast<std::size_t>(triangle)];
    const Vec3 area = 0.5 * cornersOf(t, state().rest()).areaNormal();
    force += (stress.isSet() ? Vec3(tensor_ * area) : Vec3(area.norm() * *traction)) / 3;
  });
  return force;
}

void TractionForceField::topologyChanged(const TopologyChange& change) {
  if (!surface_.follow(*this, change)) return;
  force_.resize(surface_.nodes().size());
  for (const Index n : surface_.changedNodes()) force_[static_cast<std::size_t>(n)] = fullForce(n);
}

void TractionForceField::topologyRestored() {
  if (surface_.restore()) computeForces();
}

double TractionForceField::factorAt(double time) const {
  return scale * smoothRamp(time, rampTime);
}

void TractionForceField::addForce(const StateView& at, Vec3Span f) {
  const double factor = factorAt(at.time);
  for (std::size_t n = 0; n < force_.size(); ++n) {
    f[static_cast<std::size_t>(surface_.nodes()[n])] += factor * force_[n];
  }
}

double TractionForceField::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (std::size_t n = 0; n < force_.size(); ++n) {
    energy -= force_[n].dot(at.x[static_cast<std::size_t>(surface_.nodes()[n])]);
  }
  return factorAt(at.time) * energy;
}

}  // namespace stroma
