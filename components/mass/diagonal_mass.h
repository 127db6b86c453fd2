// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mass.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// Mass of each particle = density x the volume it stands for, so that the masses add up to density
// x volume of the body. Volumes come from the topology (a sampler, a grid) or from `volume`.
class DiagonalMass final : public Mass {
 public:
  Attribute<double> massDensity{this,
                                "massDensity",
                                0.0,
                                "Density of the material.",
                                {.unit = "kg/m^3", .min = 0, .exclusiveMin = true}};
  Attribute<double> totalMass{
      this,
      "totalMass",
      0.0,
      "Mass of all particles together, shared out by volume; instead of a density.",
      {.unit = "kg", .min = 0, .exclusiveMin = true}};
  Attribute<std::vector<double>> vertexMass{
      this, "vertexMass", {}, "Mass of each particle, given one by one.", {.unit = "kg", .min = 0}};
  Attribute<std::vector<double>> volume{this,
                                        "volume",
                                        {},
                                        "Volume of each particle, instead of the topology's.",
                                        {.unit = "m^3", .min = 0, .autolink = true}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles that have the mass.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{
      this, "topology", "Where the volumes come from.", Lookup::sameNode, {.required = false}};

  void configure() override;
  void bind() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addMasses(std::span<double> masses) const override;

 private:
  std::vector<double> mass_;
};

}  // namespace stroma
