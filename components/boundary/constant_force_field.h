// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/boundary/shared_nodes.h"
#include "core/interfaces/force_field.h"

namespace stroma {

// The same forces at all times, on chosen particles or on all. Energy -sum f.x; no derivative. A
// cut leaves the load as it is: a node and the copy that is separated from it share the node's
// force.
class ConstantForceField final : public ForceField {
 public:
  Attribute<IndexList> indices{this,
                               "indices",
                               {},
                               "Particles acted on; all of them when not given.",
                               {.aliases = "points"}};
  Attribute<std::vector<Vec3>> forces{this,
                                      "forces",
                                      {},
                                      "Force on each of the particles; the last one holds for all "
                                      "that follow.",
                                      {.unit = "N", .runtime = true, .aliases = "force"}};
  Attribute<Vec3> totalForce{this,
                             "totalForce",
                             Vec3::Zero(),
                             "Force on all of the particles together, shared out evenly; instead "
                             "of 'forces'.",
                             {.unit = "N", .runtime = true}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void configure() override;
  void bind() override;
  void attributeChanged(const AttributeBase&) override { shareOut(); }
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span, double, double, Vec3Span) const override {}
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }

 private:
  void shareOut();
  SharedNodes particles_;
  std::vector<Vec3> force_;  // on each of them
};

}  // namespace stroma
