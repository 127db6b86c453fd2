// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/constant_force_field.h"

#include <algorithm>

#include "components/boundary/index_check.h"
#include "core/parallel.h"

namespace stroma {

void ConstantForceField::configure() {
  if (forces.isSet() == totalForce.isSet()) {
    error("attr-required", std::string("needs one of 'forces' and 'totalForce'") +
                               (forces.isSet() ? ", not both" : ""));
  } else if (forces.isSet() && !forces.source() && forces->empty()) {
    error(forces, "value-count", "is empty");
  }
}

void ConstantForceField::bind() {
  if (!checkIndices(*this, indices, state())) return;
  particles_.set(indices.isSet() ? indices->indices : allIndices(state().size()));
  if (forces->size() > particles_.size()) {
    error(forces, "value-count",
          "has " + std::to_string(forces->size()) + " forces for " +
              std::to_string(particles_.size()) + " particles");
    return;
  }
  shareOut();
}

void ConstantForceField::shareOut() {
  const std::vector<Vec3>& given = forces;
  const bool each = forces.isSet() && !given.empty();
  force_.resize(particles_.size());
  for (std::size_t k = 0; k < force_.size(); ++k) {
    const Vec3 whole = each ? given[std::min(particles_.origin(k), given.size() - 1)]
                            : Vec3(*totalForce / static_cast<double>(particles_.originCount()));
    force_[k] = particles_.share(k) * whole;
  }
}

void ConstantForceField::topologyChanged(const TopologyChange& change) {
  if (&change.nodes != &state()) return;
  particles_.follow(change, [&](std::size_t k) { force_.push_back(force_[k] *= 0.5); });
}

void ConstantForceField::topologyRestored() {
  particles_.restore();
  shareOut();
}

void ConstantForceField::addForce(const StateView&, Vec3Span f) {
  parallelFor(static_cast<Index>(particles_.size()), [&](Index n) {
    const auto k = static_cast<std::size_t>(n);
    f[particles_.node(k)] += force_[k];
  });
}

double ConstantForceField::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    energy -= force_[k].dot(at.x[particles_.node(k)]);
  }
  return energy;
}

}  // namespace stroma
