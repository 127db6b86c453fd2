// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/energy_debt.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "components/material/symmetric_eigen.h"
#include "core/snapshot.h"
#include "core/sorted_ids.h"
#include "core/system.h"

namespace stroma {

namespace {

// v(x) = linear + angular x (x - centre) with the momenta of the particles.
struct RigidMotion {
  Vec3 centre, linear, angular;
  [[nodiscard]] Vec3 at(const Vec3& x) const { return linear + angular.cross(x - centre); }
};

RigidMotion commonMotion(std::span<const Index> particles, std::span<const double> mass,
                         ConstVec3Span x, ConstVec3Span v) {
  double sum = 0;
  Vec3 centre = Vec3::Zero(), linear = Vec3::Zero(), spin = Vec3::Zero();
  for (const Index i : particles) {
    sum += mass[i];
    centre += mass[i] * x[i];
    linear += mass[i] * v[i];
  }
  centre /= sum;
  linear /= sum;
  Mat3 inertia = Mat3::Zero();
  for (const Index i : particles) {
    const Vec3 r = x[i] - centre;
    spin += mass[i] * r.cross(v[i] - linear);
    inertia += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  const SymmetricEigen<3> axes = symmetricEigen<3>(inertia);
  Vec3 rates = axes.vectors.transpose() * spin;
  // a single particle, or a row of them, has no inertia about some axis
  for (int k = 0; k < 3; ++k)
    rates[k] = axes.values[k] > 1e-12 * axes.values[2] ? rates[k] / axes.values[k] : 0;
  return {centre, linear, axes.vectors * rates};
}

}  // namespace

void EnergyDebt::owe(double energy, std::span<const Index> particles) {
  owed_ += energy;
  std::vector<Index> all;
  std::ranges::set_union(particles_, particles, std::back_inserter(all));
  particles_ = std::move(all);
}

void EnergyDebt::pay(System& system, const MechanicalState& state) {
  if (!(owed_ > 0)) return;
  const Index offset = system.offsetOf(state);
  const auto mass = system.mass().subspan(static_cast<std::size_t>(offset));
  const Vec3Span v = state.v();
  std::vector<Index> fixed;  // what is held in any direction does not give
  for (const ParticleProjector& p : system.projectors()) fixed.push_back(p.particle - offset);
  sortUnique(fixed);
  std::vector<Index> free;
  std::ranges::set_difference(particles_, fixed, std::back_inserter(free));
  if (free.empty()) return;
  const RigidMotion motion = commonMotion(free, mass, state.x(), v);
  double held = 0;
  for (const Index i : free) held += 0.5 * mass[i] * (v[i] - motion.at(state.x()[i])).squaredNorm();
  if (!(held > 0)) return;
  const double payment = std::min(held, owed_);
  const double kept = std::sqrt(1 - payment / held);
  for (const Index i : free) {
    const Vec3 rigid = motion.at(state.x()[i]);
    v[i] = rigid + kept * (v[i] - rigid);
  }
  owed_ -= payment;
  paid_ += payment;
  if (owed_ == 0) particles_.clear();
}

void EnergyDebt::save(StateWriter& writer) const {
  writer.write("energyOwed", owed_);
  writer.write("energyPaid", paid_);
  writer.write("energyOwedBy", std::span<const Index>(particles_));
}

void EnergyDebt::restore(StateReader& reader) {
  static_cast<void>(reader.read("energyOwed", owed_));
  static_cast<void>(reader.read("energyPaid", paid_));
  particles_.resize(reader.count<Index>("energyOwedBy"));
  if (!reader.read("energyOwedBy", std::span(particles_))) clear();
}

}  // namespace stroma
