// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/traction_force_field.h"

#include "components/boundary/ramp.h"

namespace stroma {

namespace {

Mat3 symmetric(std::span<const double> s) {
  Mat3 tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

}  // namespace

void TractionForceField::configure() {
  if (traction.isSet() == (stress.isSet() || stressGradient.isSet())) {
    error("attr-required", "needs one of 'traction' and 'stress' (or 'stressGradient')");
  } else if (stress.isSet() && !stress.source() && stress->size() != 6) {
    error(stress, "value-count",
          "has " + std::to_string(stress->size()) + " values, expected 6: xx yy zz xy yz zx");
  } else if (stressOrigin.isSet() && !stressGradient.isSet()) {
    error(stressOrigin, "attr-unused", "has no meaning without 'stressGradient'");
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
    tensor_ = symmetric(s);
  }
  if (stressGradient.isSet() && stressGradient->size() != 18) {
    error(stressGradient, "value-count",
          "has " + std::to_string(stressGradient->size()) +
              " values, expected 18: xx yy zz xy yz zx, derived by x, by y and by z");
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    slope_[k] = stressGradient.isSet() ? symmetric(std::span(*stressGradient).subspan(6 * k, 6))
                                       : Mat3(Mat3::Zero());
  }
  computeForces();
}

void TractionForceField::computeForces() {
  force_.resize(surface_.nodes().size());
  for (std::size_t n = 0; n < force_.size(); ++n) force_[n] = fullForce(static_cast<Index>(n));
}

Vec3 TractionForceField::tractionAt(const Vec3& X, const Vec3& normal) const {
  if (traction.isSet()) return traction;
  Mat3 here = tensor_;
  for (int k = 0; k < 3; ++k)
    here += (X[k] - stressOrigin.value()[k]) * slope_[static_cast<std::size_t>(k)];
  return here * normal;
}

Vec3 TractionForceField::fullForce(Index place) const {
  const ConstVec3Span X = state().rest();
  const Index node = surface_.nodes()[static_cast<std::size_t>(place)];
  Vec3 force = Vec3::Zero();
  surface_.forCorners(place, [&](Index triangle, Index) {
    const Triangle& t = surface_.triangles()[static_cast<std::size_t>(triangle)];
    const Vec3 twiceArea = cornersOf(t, X).areaNormal();
    const Vec3 normal = twiceArea.normalized();
    Vec3 sum = tractionAt(X[static_cast<std::size_t>(node)], normal);
    for (const Index corner : t) sum += tractionAt(X[static_cast<std::size_t>(corner)], normal);
    force += twiceArea.norm() / 24 * sum;
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
