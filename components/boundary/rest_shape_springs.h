// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/boundary/shared_nodes.h"
#include "core/interfaces/force_field.h"

namespace stroma {

// Springs of zero length between particles and their own rest positions: an elastic support, such
// as the limbus of a cornea. f = k (X - x), energy k/2 |x - X|^2. Unlike in SOFA nothing is chosen
// silently: which points, and how stiff, must be written. A node and the copy that a cut separates
// from it share the spring's stiffness.
class RestShapeSpringsForceField final : public ForceField {
 public:
  Attribute<IndexList> points{
      this, "points", {}, "Particles that are held by a spring.", {.aliases = "indices"}};
  Attribute<bool> all{this, "all", false, "Every particle has a spring; instead of 'points'."};
  Attribute<std::vector<double>> stiffness{this,
                                           "stiffness",
                                           {},
                                           "Stiffness of each spring; one value holds for all.",
                                           {.unit = "N/m", .min = 0, .required = true}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void configure() override;
  void bind() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                  double damping) const override;

 private:
  [[nodiscard]] double stiffnessAt(std::size_t k) const {
    return points_.share(k) * stiffness_[points_.origin(k)];
  }
  SharedNodes points_;
  std::vector<double> stiffness_;  // of each point before any cut
};

}  // namespace stroma
