// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mass.h"

namespace stroma {

// The same mass for every particle. Unlike in SOFA there is no silent total of 1 kg: one of the two
// attributes is required.
class UniformMass final : public Mass {
 public:
  Attribute<double> totalMass{
      this,
      "totalMass",
      0.0,
      "Mass of all particles together.",
      {.unit = "kg", .min = 0, .exclusiveMin = true, .aliases = "totalmass"}};
  Attribute<double> vertexMass{
      this,
      "vertexMass",
      0.0,
      "Mass of each particle, instead of the total.",
      {.unit = "kg", .min = 0, .exclusiveMin = true, .aliases = "vertexmass mass"}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles that have the mass.", Lookup::sameNode, {.aliases = "mstate"}};

  void configure() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addMasses(std::span<double> masses) const override;
};

}  // namespace stroma
