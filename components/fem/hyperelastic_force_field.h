// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/fem/element_force_field.h"

namespace stroma {

enum class HyperelasticLaw { StVenantKirchhoff, NeoHookean, StableNeoHookean };

template <>
struct EnumNames<HyperelasticLaw> {
  static constexpr std::array<std::pair<HyperelasticLaw, std::string_view>, 3> names = {
      {{HyperelasticLaw::StVenantKirchhoff, "StVenantKirchhoff"},
       {HyperelasticLaw::NeoHookean, "NeoHookean"},
       {HyperelasticLaw::StableNeoHookean, "StableNeoHookean"}}};
};

// Linear tetrahedra of a hyperelastic law, under SOFA's name. Moduli are given by ParameterSet as
// in SOFA, or by Young's modulus and Poisson's ratio, the small-strain ones of every law.
//   StVenantKirchhoff: mu E:E + lambda/2 tr(E)^2, Green's strain
//   NeoHookean:        mu/2 (J^(-2/3) I - 3) + k/2 log(J)^2
//   StableNeoHookean:  mu/2 (I - 3) + (lambda + mu)/2 (J - 1 - mu/(lambda + mu))^2
class TetrahedronHyperelasticityForceField final : public ElementForceField<LinearTetrahedron> {
 public:
  static constexpr std::string_view role = "TetrahedronHyperelasticityFEMForceField";

  Attribute<HyperelasticLaw> materialName{
      this,
      "materialName",
      HyperelasticLaw::StableNeoHookean,
      "StVenantKirchhoff (Green's strain; fails in strong compression), NeoHookean (does not "
      "survive inversion), StableNeoHookean (does).",
      {.required = true}};
  Attribute<std::vector<double>> parameterSet{
      this,
      "ParameterSet",
      {},
      "Moduli: \"mu lambda\" of StVenantKirchhoff and StableNeoHookean, \"mu bulk\" of NeoHookean; "
      "instead of youngModulus and poissonRatio.",
      {.unit = "Pa"}};

  void configure() override;
  void bind() override;

 protected:
  [[nodiscard]] std::unique_ptr<ElementLaw> makeLaw() const override;
};

}  // namespace stroma
