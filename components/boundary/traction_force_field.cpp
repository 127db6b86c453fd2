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
  Mat3 tensor = Mat3::Zero();
  if (stress.isSet()) {
    const std::vector<double>& s = stress;
    if (s.size() != 6) {
      error(stress, "value-count", "has " + std::to_string(s.size()) + " numbers, expected 6");
      return;
    }
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  }
  const ConstVec3Span rest = state().rest();
  force_.assign(surface_.nodes().size(), Vec3::Zero());
  for (std::size_t n = 0; n < force_.size(); ++n) {
    for (const auto& corner : surface_.cornersAt(static_cast<Index>(n))) {
      const Triangle& t = surface_.triangles()[static_cast<std::size_t>(corner.triangle)];
      const Vec3& a = rest[static_cast<std::size_t>(t[0])];
      const Vec3 area = 0.5 * (rest[static_cast<std::size_t>(t[1])] - a)
                                  .cross(rest[static_cast<std::size_t>(t[2])] - a);
      force_[n] += (stress.isSet() ? Vec3(tensor * area) : Vec3(area.norm() * *traction)) / 3;
    }
  }
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
