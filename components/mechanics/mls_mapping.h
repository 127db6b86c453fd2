// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/mechanics/mls_force_field.h"
#include "core/interfaces/mapping.h"

namespace stroma {

// Surface nodes that ride on particles: x_s = sum_i w_si [x_i + F_i (X_s - X_i)], the Shepard blend
// over the nearest particles of their first-order extrapolations. Linear fields are followed
// exactly; forces on the nodes go back to the particles by the exact transpose. With the force
// field's own number of supports these are the shape functions of the consistent gradient's
// boundary term, so that tractions are exact. After a cut each node is carried by particles that it
// sees (riding_points.h).
class MLSMapping final : public Mapping {
 public:
  Attribute<int> supportCount{
      this,
      "supportCount",
      0,
      "Particles that carry a node; 0 takes the force field's surfaceSupport.",
      {.min = 0}};
  Link<MechanicalState> in{this, "input", "Particles.", Lookup::parent};
  Link<MechanicalState> out{this, "output", "Surface nodes.", Lookup::sameNode};
  Link<Mesh> surface{this,
                     "topology",
                     "Triangles between the nodes; nodes without any are mapped as "
                     "single points.",
                     Lookup::sameNode,
                     {.required = false}};
  Link<MLSForceField> forceField{this, "forceField",
                                 "Force field of the particles, which knows their "
                                 "neighbourhoods.",
                                 Lookup::nearest};

  Limiter freeChips{this, "freeChips",
                    "nodes with fewer than 8 supports on their own side of the cuts"};

  void bind() override;
  void start() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void checkTopology(TopologyCheck& check) const override;
  [[nodiscard]] MechanicalState& input() const override { return *in; }
  [[nodiscard]] MechanicalState& output() const override { return *out; }
  void apply(ConstVec3Span particles, Vec3Span points) const override;
  void applyJ(ConstVec3Span particles, Vec3Span points) const override;
  void addTransposed(ConstVec3Span points, Vec3Span particles) const override;

  [[nodiscard]] const SurfaceShape& shape() const { return points_->shape; }

 private:
  // What was mapped last: solvers ask for the end of a step again at the beginning of the next.
  struct Last {
    std::vector<Vec3> in;
    const Vec3* out = nullptr;
    [[nodiscard]] bool isStill(ConstVec3Span particles, Vec3Span points);
  };
  void findShape();
  [[nodiscard]] bool isCut() const;  // whether its nodes are those of the surface that is cut

  std::shared_ptr<RidingPoints> points_;
  mutable Last positions_, velocities_;
};

}  // namespace stroma
