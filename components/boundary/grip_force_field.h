// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "components/boundary/shared_nodes.h"
#include "core/interfaces/force_field.h"
#include "core/schedule.h"

namespace stroma {

// A grip that follows a script: every gripped node hangs on a spring from its start position +
// scale x displacement(t), where displacement(t) is linear between the key times and constant
// outside them. The start position is where the node is when the grip closes. f = k (target - x),
// energy k/2 |x - target|^2. When a gripped node is separated by a cut, its copy is gripped, too;
// the two share the spring's stiffness, so that a cut does not change the grip's force.
class GripForceField final : public ForceField {
 public:
  Attribute<IndexList> indices{this, "indices", {}, "Nodes that are gripped.", {.required = true}};
  Attribute<double> stiffness{this,
                              "stiffness",
                              0.0,
                              "Stiffness of each node's spring.",
                              {.unit = "N/m", .min = 0, .exclusiveMin = true, .required = true}};
  Attribute<std::vector<double>> keyTimes{
      this, "keyTimes", {}, "Times of the path, rising.", {.unit = "s", .required = true}};
  Attribute<std::vector<Vec3>> displacements{this,
                                             "displacements",
                                             {},
                                             "Displacement of the grip at each key time.",
                                             {.unit = "m", .required = true}};
  Attribute<double> scale{this,
                          "scale",
                          1.0,
                          "Factor of the displacements; -1 reverses the motion.",
                          {.runtime = true}};
  Attribute<double> grasp{this,
                          "grasp",
                          0.0,
                          "Time at which the grip closes; not given = at the start of the scene.",
                          {.unit = "s"}};
  Attribute<double> release{this,
                            "release",
                            std::numeric_limits<double>::max(),
                            "Time at which the grip opens; not given = never.",
                            {.unit = "s"}};
  Attribute<Vec3> force{this,
                        "force",
                        Vec3::Zero(),
                        "Force of the grip on all of its nodes together, at the end of the step.",
                        {.unit = "N", .output = true}};
  Attribute<Vec3> displacement{this,
                               "displacement",
                               Vec3::Zero(),
                               "scale x displacement(t), at the end of the step.",
                               {.unit = "m", .output = true}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Nodes acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void bind() override;
  void start() override;
  void reset() override { start(); }
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView& at) override { holdsLinear_ = holds(at.time); }
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                  double damping) const override;

  [[nodiscard]] Vec3 displacementAt(double time) const;

 private:
  void close();
  void closeWhenDue(const StepContext& step);
  void publish(const StepContext& step);
  [[nodiscard]] bool holds(double time) const { return closed_ && time < release; }
  [[nodiscard]] double stiffnessAt(std::size_t k) const { return nodes_.share(k) * stiffness; }

  SharedNodes nodes_;
  std::vector<Vec3> anchor_;  // start position of each gripped node
  bool closed_ = false;
  bool holdsLinear_ = false;
};

}  // namespace stroma
