// SPDX-License-Identifier: Apache-2.0
#include "components/collision/grip_contact.h"

#include <algorithm>

#include "core/snapshot.h"
#include "core/topology_change.h"

namespace stroma {

void GripContact::start() {
  held_.clear();
  share_.clear();
  local_.clear();
  target_.clear();
  closed_ = false;
  nodeCount.set(0);
  force.set(Vec3::Zero());
}

void GripContact::schedule(Schedule& schedule) {
  schedule.add<&GripContact::follow>(Stage::Collide, *this, "grip or let go");
  // after the mapped states have followed, before the devices get their force
  schedule.add<&GripContact::publish>(Stage::Guard, *this, "force of the grip");
}

void GripContact::follow(const StepContext&) {
  if (tool->active() != closed_) {
    if (closed_) {
      start();
    } else {
      close();
    }
  }
  for (std::size_t k = 0; k < held_.size(); ++k) target_[k] = tool->pose() * local_[k];
}

// Where the nodes are now is where the tool was at the beginning of the step.
void GripContact::close() {
  const Pose& pose = tool->previousPose();
  const ConstVec3Span x = state().x();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 local = pose.orientation.conjugate() * (x[i] - pose.position);
    if (local.norm() > tool->radius()) continue;
    held_.push_back(static_cast<Index>(i));
    local_.push_back(local);
  }
  target_.resize(held_.size());
  share_.assign(held_.size(), 1);
  closed_ = true;
  nodeCount.set(static_cast<int>(held_.size()));
  if (held_.empty()) ++closedOnNothing_;
}

void GripContact::addForce(const StateView& at, Vec3Span f) {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto i = static_cast<std::size_t>(held_[k]);
    f[i] += stiffnessAt(k) * (target_[k] - at.x[i]);
  }
}

double GripContact::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Vec3& x = at.x[static_cast<std::size_t>(held_[k])];
    energy += 0.5 * stiffnessAt(k) * (target_[k] - x).squaredNorm();
  }
  return energy;
}

void GripContact::addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double,
                                    Vec3Span df) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto i = static_cast<std::size_t>(held_[k]);
    df[i] -= (stiffnessFactor * stiffnessAt(k)) * dx[i];
  }
}

void GripContact::publish(const StepContext&) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Vec3& x = state().x()[static_cast<std::size_t>(held_[k])];
    const Vec3 pull = stiffnessAt(k) * (target_[k] - x);
    sum += pull;
    tool->addForce(-pull, x);
  }
  force.set(sum);
}

void GripContact::save(StateWriter& writer) const {
  writer.write("closed", static_cast<int>(closed_));
  writer.write("held", std::span<const Index>(held_));
  writer.write("share", std::span<const double>(share_));
  writer.write("local", ConstVec3Span(local_));
  writer.write("target", ConstVec3Span(target_));
}

void GripContact::restore(StateReader& reader) {
  int closed = 0;
  start();
  held_.resize(reader.count<Index>("held"));
  share_.resize(held_.size());
  local_.resize(held_.size());
  target_.resize(held_.size());
  if (!reader.read("closed", closed) || !reader.read("held", std::span<Index>(held_)) ||
      !reader.read("share", std::span<double>(share_)) || !reader.read("local", Vec3Span(local_)) ||
      !reader.read("target", Vec3Span(target_))) {
    return start();
  }
  closed_ = closed != 0;
  nodeCount.set(static_cast<int>(held_.size()));
}

void GripContact::topologyChanged(const TopologyChange& change) {
  if (&change.nodes != &state()) return;
  for (std::size_t n = 0; n < change.edit.nodes.size(); ++n) {
    const auto at = std::ranges::find(held_, change.edit.nodes[n].copyOf);
    if (at == held_.end()) continue;
    const auto k = static_cast<std::size_t>(at - held_.begin());
    held_.push_back(change.edit.firstNewNode + static_cast<Index>(n));
    share_.push_back(share_[k] *= 0.5);
    local_.push_back(local_[k]);
    target_.push_back(target_[k]);
  }
  nodeCount.set(static_cast<int>(held_.size()));
}

}  // namespace stroma
