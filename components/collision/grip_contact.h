// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/force_field.h"
#include "core/interfaces/tool.h"
#include "core/schedule.h"

namespace stroma {

// Forceps on a surface. When the tool's trigger closes, every node within the tool's radius of its
// tip is hung on a spring to where it is in the tool's frame, so that closing pulls at nothing; the
// springs move and turn with the tool until the trigger opens. f = k (target - x), energy
// k/2 |x - target|^2. The tool gets the opposite forces at the nodes.
//
// When the surface is cut through a held node, its copy is held at the same place; the two share
// the spring's stiffness, so that a cut neither pulls nor adds energy.
class GripContact final : public ForceField {
 public:
  Attribute<double> stiffness{
      this,
      "stiffness",
      0.0,
      "Stiffness of each node's spring.",
      {.unit = "N/m", .min = 0, .exclusiveMin = true, .required = true, .runtime = true}};
  Attribute<int> nodeCount{this, "nodeCount", 0, "Nodes that are held.", {.output = true}};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force on all held nodes together, at the end of the step.",
                        {.unit = "N", .output = true}};
  Link<Tool> tool{this, "tool", "What grips.", Lookup::explicitOnly};
  Link<MechanicalState> mechanicalState{
      this, "state", "Nodes that can be held.", Lookup::nearest, {.aliases = "mstate"}};

  void start() override;
  void reset() override { start(); }
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override { start(); }
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double damping,
                         Vec3Span df) const override;
  // No pattern: which nodes are held changes during the run.

 private:
  void follow(const StepContext& step);
  void close();
  void publish(const StepContext& step);

  [[nodiscard]] double stiffnessAt(std::size_t k) const { return share_[k] * stiffness; }

  std::vector<Index> held_;
  std::vector<double> share_;  // of each held node in a spring's stiffness, 1 unless it was cut
  std::vector<Vec3> local_;    // of each held node, in the tool's frame
  std::vector<Vec3> target_;   // the same in the scene, at the end of the step
  bool closed_ = false;
  Limiter closedOnNothing_{this, "closedOnNothing", "The grip closed where no node was in reach."};
};

}  // namespace stroma
