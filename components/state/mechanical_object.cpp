// SPDX-License-Identifier: Apache-2.0
#include "components/state/mechanical_object.h"

#include "core/rigid_motion.h"

namespace stroma {

void MechanicalObject::bind() {
  if (!position->empty()) {
    initialX_ = position;
  } else if (topology) {
    initialX_.assign(topology->positions().begin(), topology->positions().end());
  }
  if (initialX_.empty()) {
    error("state-empty", "has no particles: give 'position' or add a topology to the node");
    return;
  }
  const Mat3 r = fromEuler(rotation).toRotationMatrix();
  const bool moved = translation.isSet() || rotation.isSet() || scale.isSet();
  if (moved) {
    for (Vec3& x : initialX_) x = r * scale->cwiseProduct(x) + *translation;
  }
  rest_ = restPosition->empty() ? initialX_ : *restPosition;
  if (rest_.size() != initialX_.size()) {
    error(restPosition, "state-size",
          "has " + std::to_string(rest_.size()) + " points, 'position' " +
              std::to_string(initialX_.size()));
    return;
  }
  initialV_ = velocity;
  if (initialV_.size() <= 1) {
    initialV_.assign(initialX_.size(), initialV_.empty() ? Vec3::Zero().eval() : initialV_.front());
  }
  if (initialV_.size() != initialX_.size()) {
    error(velocity, "state-size",
          "has " + std::to_string(initialV_.size()) + " values for " +
              std::to_string(initialX_.size()) + " particles");
  }
}

}  // namespace stroma
