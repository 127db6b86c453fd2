// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/grip_force_field.h"

#include <algorithm>

#include "components/boundary/index_check.h"
#include "core/snapshot.h"

namespace stroma {

void GripForceField::bind() {
  if (!checkIndices(*this, indices, state())) return;
  nodes_.set(indices->indices);
  anchor_.assign(nodes_.size(), Vec3::Zero());
  if (keyTimes->empty() || keyTimes->size() != displacements->size()) {
    error(displacements, "value-count",
          "has " + std::to_string(displacements->size()) + " displacements for " +
              std::to_string(keyTimes->size()) + " key times");
  }
  if (!std::ranges::is_sorted(*keyTimes, std::ranges::less_equal())) {
    error(keyTimes, "value-order", "does not rise from each time to the next");
  }
  if (grasp.isSet() && release <= grasp) error(release, "value-range", "is not after 'grasp'");
}

void GripForceField::start() {
  closed_ = false;
  if (!grasp.isSet()) close();
}

void GripForceField::close() {
  for (std::size_t k = 0; k < anchor_.size(); ++k) anchor_[k] = state().x()[nodes_.node(k)];
  closed_ = true;
}

void GripForceField::topologyChanged(const TopologyChange& change) {
  if (&change.nodes != &state()) return;
  nodes_.follow(change, [&](std::size_t k) { anchor_.push_back(anchor_[k]); });
}

void GripForceField::topologyRestored() {
  nodes_.restore();
  anchor_.resize(nodes_.size());
}

void GripForceField::schedule(Schedule& schedule) {
  if (grasp.isSet()) {
    schedule.add<&GripForceField::closeWhenDue>(Stage::Input, *this, "close the grip when due");
  }
  // after the mapped states have followed, before the exporters run
  schedule.add<&GripForceField::publish>(Stage::Guard, *this, "force of the grip");
}

void GripForceField::closeWhenDue(const StepContext& step) {
  if (!closed_ && step.time + 0.5 * step.dt >= grasp) close();
}

Vec3 GripForceField::displacementAt(double time) const {
  const std::vector<double>& key = keyTimes;
  const std::vector<Vec3>& path = displacements;
  const auto after = std::ranges::upper_bound(key, time);
  if (after == key.begin()) return scale * path.front();
  if (after == key.end()) return scale * path.back();
  const auto k = static_cast<std::size_t>(after - key.begin());
  const double s = (time - key[k - 1]) / (key[k] - key[k - 1]);
  return scale * ((1 - s) * path[k - 1] + s * path[k]);
}

void GripForceField::addForce(const StateView& at, Vec3Span f) {
  if (!holds(at.time)) return;
  const Vec3 shift = displacementAt(at.time);
  for (std::size_t k = 0; k < anchor_.size(); ++k) {
    const std::size_t i = nodes_.node(k);
    f[i] += stiffnessAt(k) * (anchor_[k] + shift - at.x[i]);
  }
}

double GripForceField::potentialEnergy(const StateView& at) const {
  if (!holds(at.time)) return 0;
  const Vec3 shift = displacementAt(at.time);
  double energy = 0;
  for (std::size_t k = 0; k < anchor_.size(); ++k) {
    energy += 0.5 * stiffnessAt(k) * (anchor_[k] + shift - at.x[nodes_.node(k)]).squaredNorm();
  }
  return energy;
}

void GripForceField::addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double,
                                       Vec3Span df) const {
  if (!holdsLinear_) return;
  for (std::size_t k = 0; k < anchor_.size(); ++k) {
    df[nodes_.node(k)] -= (stiffnessFactor * stiffnessAt(k)) * dx[nodes_.node(k)];
  }
}

void GripForceField::addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                                double) const {
  if (!holdsLinear_) return;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    matrix.addDiagonal(offset + nodes_.nodes()[k], -stiffnessFactor * stiffnessAt(k));
  }
}

void GripForceField::publish(const StepContext& step) {
  const Vec3 shift = displacementAt(step.time);
  Vec3 sum = Vec3::Zero();
  if (holds(step.time)) {
    for (std::size_t k = 0; k < anchor_.size(); ++k) {
      sum += stiffnessAt(k) * (anchor_[k] + shift - state().x()[nodes_.node(k)]);
    }
  }
  displacement.set(shift);
  force.set(sum);
}

void GripForceField::save(StateWriter& writer) const {
  writer.write("closed", static_cast<int>(closed_));
  writer.write("anchor", ConstVec3Span(anchor_));
}

void GripForceField::restore(StateReader& reader) {
  int closed = closed_;
  if (reader.read("closed", closed) && reader.read("anchor", Vec3Span(anchor_))) {
    closed_ = closed != 0;
  }
}

}  // namespace stroma
