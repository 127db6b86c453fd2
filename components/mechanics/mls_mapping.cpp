// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_mapping.h"

#include <algorithm>
#include <cstring>

namespace stroma {

void MLSMapping::bind() {
  if (&forceField->state() != in.get()) {
    error(forceField, "mapping-force-field",
          "acts on '" + forceField->state().path() + "', but the input is '" + in->path() + "'");
    return;
  }
  const auto nodes = static_cast<Index>(out->rest().size());
  for (const Triangle& t : surface ? surface->triangles() : std::span<const Triangle>{}) {
    const Index last = *std::ranges::max_element(t);
    if (last < nodes) continue;
    error(surface, "mapping-mesh",
          "has a triangle with node " + std::to_string(last) + ", but '" + out->path() + "' has " +
              std::to_string(nodes) + " nodes",
          "the output is the state of that mesh's own points");
    return;
  }
  findShape();
}

void MLSMapping::findShape() {
  positions_ = velocities_ = {};
  const Index supports = supportCount > 0 ? *supportCount : *forceField->surfaceSupport;
  const auto triangles = surface ? surface->triangles() : std::span<const Triangle>{};
  points_ = forceField->shapeOf(out->rest(), triangles, supports);
}

bool MLSMapping::isCut() const { return &forceField->modifier()->nodes() == out.get(); }

void MLSMapping::start() {
  if (!forceField->modifier()) return;
  // nodes that are not cut get no new ones: they need a shape of their own
  if (!isCut()) points_ = std::make_shared<RidingPoints>(*points_);
  prepareForCuts(*points_, out->rest(), in->rest());
}

void MLSMapping::topologyChanged(const TopologyChange& change) {
  if (!forceField->modifier() || &change.particles != in.get()) return;
  positions_ = velocities_ = {};
  forceField->follow(*points_, out->rest(), isCut(), change);
  freeChips.add(static_cast<std::uint64_t>(points_->newChips));
  points_->shape.applyTo(points_->redone, in->x(), out->x());
  points_->shape.applyTo(points_->redone, in->v(), out->v());
}

void MLSMapping::topologyRestored() {
  if (!forceField->modifier() || points_->change == 0) return;
  findShape();
  start();
}

void MLSMapping::checkTopology(TopologyCheck& check) const {
  if (!forceField->modifier() || &check.particles != in.get()) return;
  checkPoints(*points_, out->rest(), forceField->cutParticles(), path() + ": node", check);
}

// To the bit; remembers what it was asked.
bool MLSMapping::Last::isStill(ConstVec3Span particles, Vec3Span points) {
  const bool same = out == points.data() && in.size() == particles.size() &&
                    std::memcmp(in.data(), particles.data(), particles.size_bytes()) == 0;
  if (!same) in.assign(particles.begin(), particles.end());
  out = points.data();
  return same;
}

void MLSMapping::apply(ConstVec3Span particles, Vec3Span points) const {
  if (positions_.isStill(particles, points)) return;
  const bool isState = particles.data() == in->x().data() && points.data() == out->x().data();
  if (isState && !velocities_.isStill(in->v(), out->v())) {
    // whoever asks for the state's positions asks for its velocities next
    points_->shape.apply(particles, in->v(), points, out->v());
  } else {
    points_->shape.apply(particles, points);
  }
}

void MLSMapping::applyJ(ConstVec3Span particles, Vec3Span points) const {
  const bool isState = points.data() == out->v().data();  // not some direction of a solver
  if (!isState || !velocities_.isStill(particles, points)) points_->shape.apply(particles, points);
}

void MLSMapping::addTransposed(ConstVec3Span points, Vec3Span particles) const {
  points_->shape.addTransposed(points, particles);
}

}  // namespace stroma
