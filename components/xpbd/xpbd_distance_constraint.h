// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "components/xpbd/edge_distances.h"
#include "components/xpbd/xpbd_mesh_constraint.h"

namespace stroma {

// Keeps the distances between the nodes of each edge, triangle and tetrahedron of a topology, as
// springs do (edge_distances.h); a pair that several of them have counts once.
class XpbdDistanceConstraint final : public XpbdMeshConstraint {
 public:
  static constexpr std::string_view role = "XPBDDistanceConstraint";

  Attribute<double> stiffness{
      this,
      "stiffness",
      0.0,
      "Force per strain: the constant of an edge is this over its rest length.",
      {.unit = "N", .min = 0, .exclusiveMin = true, .required = true, .runtime = true}};

  void bind() override;
  void attributeChanged(const AttributeBase&) override { edges_->setStiffness(stiffness); }
  [[nodiscard]] Index count() const override { return edges_->count(); }
  void clearMultipliers() override { edges_->clearMultipliers(); }
  void project(const XpbdParticles& particles) override {
    skipped_.add(edges_->project(particles, damping));
  }

 private:
  std::optional<EdgeDistances> edges_;
};

}  // namespace stroma
