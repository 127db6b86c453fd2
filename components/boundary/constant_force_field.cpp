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
  particle_ = indices.isSet() ? indices->indices : allIndices(state().size());
  if (forces->size() > particle_.size()) {
    error(forces, "value-count",
          "has " + std::to_string(forces->size()) + " forces for " +
              std::to_string(particle_.size()) + " particles");
    return;
  }
  shareOut();
}

void ConstantForceField::shareOut() {
  if (forces.isSet() && !forces->empty()) {
    const std::size_t given = std::min(forces->size(), particle_.size());
    force_.assign(forces->begin(), forces->begin() + static_cast<std::ptrdiff_t>(given));
    force_.resize(particle_.size(), forces->back());
  } else {
    force_.assign(particle_.size(),
                  *totalForce / static_cast<double>(std::max<std::size_t>(1, particle_.size())));
  }
}

void ConstantForceField::addForce(const StateView&, Vec3Span f) {
  parallelFor(static_cast<Index>(particle_.size()), [&](Index n) {
    const auto k = static_cast<std::size_t>(n);
    f[static_cast<std::size_t>(particle_[k])] += force_[k];
  });
}

double ConstantForceField::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (std::size_t k = 0; k < particle_.size(); ++k) {
    energy -= force_[k].dot(at.x[static_cast<std::size_t>(particle_[k])]);
  }
  return energy;
}

}  // namespace stroma
