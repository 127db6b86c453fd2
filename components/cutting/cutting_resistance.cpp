// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutting_resistance.h"

#include <cmath>

#include "core/snapshot.h"

namespace stroma {

void CuttingResistance::start() {
  shares_.clear();
  factor_ = 0;
  force.set(Vec3::Zero());
  work.set(0);
}

void CuttingResistance::schedule(Schedule& schedule) {
  schedule.add<&CuttingResistance::prepare>(Stage::Predict, *this, "tissue at the blade");
  schedule.add<&CuttingResistance::publish>(Stage::Guard, *this, "force of cutting");
}

void CuttingResistance::prepare(const StepContext&) {
  shares_.clear();
  factor_ = 0;
  const CuttingTopologyModifier::Blade& blade = modifier->blade();
  if (!blade.tool) return;
  const RestPlacement& placement = modifier->placement();
  double sum = 0;
  for (const Index i : placement.around(blade.middle)) {
    const double away =
        (state().rest()[static_cast<std::size_t>(i)] - blade.middle).norm() / placement.reach();
    shares_.push_back({i, 1 - away * away});
    sum += shares_.back().weight;
  }
  if (!(sum > 0)) return shares_.clear();
  for (Share& share : shares_) share.weight /= sum;
  const Tool& tool = *blade.tool;
  const Vec3 arm = blade.middleNow - tool.pose().position;
  speed_ = tool.linearVelocity() + tool.angularVelocity().cross(arm);
  const double relative = (speed_ - tissueMean(state().v())).norm();
  factor_ = blade.inside * (toughness / std::hypot(relative, restSpeed) + drag);
}

Vec3 CuttingResistance::tissueMean(ConstVec3Span v) const {
  Vec3 mean = Vec3::Zero();
  for (const Share& share : shares_)
    mean += share.weight * v[static_cast<std::size_t>(share.particle)];
  return mean;
}

void CuttingResistance::addForce(const StateView& at, Vec3Span f) {
  if (factor_ == 0) return;
  const Vec3 onTissue = factor_ * (speed_ - tissueMean(at.v));
  for (const Share& share : shares_)
    f[static_cast<std::size_t>(share.particle)] += share.weight * onTissue;
}

// Of the part that does not depend on the tissue's velocity; the rest has none.
double CuttingResistance::potentialEnergy(const StateView& at) const {
  return factor_ == 0 ? 0 : -factor_ * speed_.dot(tissueMean(at.x));
}

void CuttingResistance::addTangentProduct(ConstVec3Span dx, double, double damping,
                                          Vec3Span df) const {
  if (factor_ == 0 || damping == 0) return;
  const Vec3 change = -damping * factor_ * tissueMean(dx);
  for (const Share& share : shares_)
    df[static_cast<std::size_t>(share.particle)] += share.weight * change;
}

void CuttingResistance::publish(const StepContext& step) {
  force.set(Vec3::Zero());
  if (factor_ == 0) return;
  const CuttingTopologyModifier::Blade& blade = modifier->blade();
  const Vec3 relative = speed_ - tissueMean(state().v());
  force.set(-factor_ * relative);
  work.set(work + step.dt * factor_ * relative.squaredNorm());
  blade.tool->addForce(*force, blade.middleNow);
}

void CuttingResistance::save(StateWriter& writer) const { writer.write("work", work.value()); }

void CuttingResistance::restore(StateReader& reader) {
  double done = 0;
  start();
  if (reader.read("work", done)) work.set(done);
}

}  // namespace stroma
