// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cutting_resistance.h"

#include <cmath>

#include "core/snapshot.h"

namespace stroma {

void CuttingResistance::start() {
  holds_.clear();
  force.set(Vec3::Zero());
  work.set(0);
}

void CuttingResistance::schedule(Schedule& schedule) {
  schedule.add<&CuttingResistance::prepare>(Stage::Predict, *this, "tissue at the blade");
  schedule.add<&CuttingResistance::publish>(Stage::Guard, *this, "force of cutting");
}

Vec3 CuttingResistance::Hold::mean(ConstVec3Span v) const {
  Vec3 sum = Vec3::Zero();
  for (const Share& share : shares)
    sum += share.weight * v[static_cast<std::size_t>(share.particle)];
  return sum;
}

void CuttingResistance::prepare(const StepContext&) {
  holds_.clear();
  const CuttingTopologyModifier::Blade& blade = modifier->blade();
  if (!blade.tool) return;
  const Tool& tool = *blade.tool;
  const RestPlacement& placement = modifier->placement();
  for (const CuttingTopologyModifier::BladePiece& piece : blade.pieces) {
    Hold hold;
    double sum = 0;
    for (const Index i : placement.around(piece.rest)) {
      const double away =
          (state().rest()[static_cast<std::size_t>(i)] - piece.rest).norm() / placement.reach();
      hold.shares.push_back({i, 1 - away * away});
      sum += hold.shares.back().weight;
    }
    if (!(sum > 0)) continue;
    for (Share& share : hold.shares) share.weight /= sum;
    hold.now = piece.now;
    hold.speed =
        tool.linearVelocity() + tool.angularVelocity().cross(piece.now - tool.pose().position);
    const Vec3 v = hold.speed - hold.mean(state().v());
    const double speed = v.norm();
    const double sine = speed > 0 ? piece.along.cross(v).norm() / speed : 0;
    const double parting = blade.advances ? toughness * sine / std::hypot(speed, restSpeed) : 0;
    hold.factor = piece.length * (parting + drag);
    holds_.push_back(std::move(hold));
  }
}

void CuttingResistance::addForce(const StateView& at, Vec3Span f) {
  for (const Hold& hold : holds_) {
    const Vec3 onTissue = hold.factor * (hold.speed - hold.mean(at.v));
    for (const Share& share : hold.shares)
      f[static_cast<std::size_t>(share.particle)] += share.weight * onTissue;
  }
}

// Of the part that does not depend on the tissue's velocity; the rest has none.
double CuttingResistance::potentialEnergy(const StateView& at) const {
  double energy = 0;
  for (const Hold& hold : holds_) energy -= (hold.factor * hold.speed).dot(hold.mean(at.x));
  return energy;
}

void CuttingResistance::addTangentProduct(ConstVec3Span dx, double, double damping,
                                          Vec3Span df) const {
  if (damping == 0) return;
  for (const Hold& hold : holds_) {
    const Vec3 change = -damping * (hold.factor * hold.mean(dx));
    for (const Share& share : hold.shares)
      df[static_cast<std::size_t>(share.particle)] += share.weight * change;
  }
}

void CuttingResistance::publish(const StepContext& step) {
  Vec3 sum = Vec3::Zero();
  double power = 0;
  for (const Hold& hold : holds_) {
    const Vec3 relative = hold.speed - hold.mean(state().v());
    const Vec3 onBlade = -(hold.factor * relative);
    modifier->blade().tool->addForce(onBlade, hold.now);
    sum += onBlade;
    power -= onBlade.dot(relative);
  }
  force.set(sum);
  work.set(work + step.dt * power);
}

void CuttingResistance::save(StateWriter& writer) const { writer.write("work", work.value()); }

void CuttingResistance::restore(StateReader& reader) {
  double done = 0;
  start();
  if (reader.read("work", done)) work.set(done);
}

}  // namespace stroma
