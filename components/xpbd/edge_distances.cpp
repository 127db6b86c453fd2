// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/edge_distances.h"

#include <atomic>
#include <cmath>

namespace stroma {

EdgeDistances::EdgeDistances(ConstVec3Span rest, std::span<const Edge> edges)
    : colouring_(colourElements({edges.front().data(), 2 * edges.size()}, 2,
                                static_cast<Index>(rest.size()))),
      multipliers_(edges.size()) {
  springs_.reserve(edges.size());
  for (const Index e : colouring_.order) {
    const Edge& nodes = edges[static_cast<std::size_t>(e)];
    springs_.push_back({nodes, (rest[static_cast<std::size_t>(nodes[1])] -
                                rest[static_cast<std::size_t>(nodes[0])])
                                   .norm()});
  }
}

void EdgeDistances::clearMultipliers() { std::ranges::fill(multipliers_, 0.0); }

std::uint64_t EdgeDistances::project(const XpbdParticles& particles, double damping) {
  std::atomic<std::uint64_t> skipped = 0;
  forEachByColour(colouring_.begin, 256, [&](std::size_t k) {
    if (!projectOne(springs_[k], multipliers_[k], particles, damping)) ++skipped;
  });
  return skipped;
}

bool EdgeDistances::projectOne(const Spring& spring, double& multiplier,
                               const XpbdParticles& particles, double damping) const {
  const auto a = static_cast<std::size_t>(spring.nodes[0]);
  const auto b = static_cast<std::size_t>(spring.nodes[1]);
  const Vec3 edge = particles.x[b] - particles.x[a];
  const double length = edge.norm();
  if (!(length > 0)) return false;
  const Vec3 direction = edge / length;
  const Vec3 alongA = particles.movable(spring.nodes[0], direction);
  const Vec3 alongB = particles.movable(spring.nodes[1], direction);
  const double wA = particles.inverseMass[a], wB = particles.inverseMass[b];
  const double w = wA * alongA.squaredNorm() + wB * alongB.squaredNorm();
  const double k = particles.h * particles.h * stiffness_ / spring.length;
  const double c = damping / particles.h;
  const double lengthening = alongB.dot(particles.x[b] - particles.start[b]) -
                             alongA.dot(particles.x[a] - particles.start[a]);
  const double value = length - spring.length + c * lengthening;
  const double step = (-k * value - multiplier) / (1 + k * (1 + c) * w);
  if (!std::isfinite(step)) return false;
  multiplier += step;
  particles.x[a] -= wA * step * alongA;
  particles.x[b] += wB * step * alongB;
  return true;
}

}  // namespace stroma
