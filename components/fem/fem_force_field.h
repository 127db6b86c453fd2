// SPDX-License-Identifier: Apache-2.0
// Linear elastic finite elements under SOFA's names.
#pragma once

#include "components/fem/element_force_field.h"

namespace stroma {

enum class TetrahedronMethod { small, large, polar, svd };
enum class HexahedronMethod { small, large, polar };

template <>
struct EnumNames<TetrahedronMethod> {
  static constexpr std::array<std::pair<TetrahedronMethod, std::string_view>, 4> names = {
      {{TetrahedronMethod::small, "small"},
       {TetrahedronMethod::large, "large"},
       {TetrahedronMethod::polar, "polar"},
       {TetrahedronMethod::svd, "svd"}}};
};
template <>
struct EnumNames<HexahedronMethod> {
  static constexpr std::array<std::pair<HexahedronMethod, std::string_view>, 3> names = {
      {{HexahedronMethod::small, "small"},
       {HexahedronMethod::large, "large"},
       {HexahedronMethod::polar, "polar"}}};
};

// `method` says it in SOFA's words: small is Hooke's law with Cauchy's strain; every other one
// removes the rotation at each quadrature point by the exact polar decomposition, with its exact
// derivative. `material` and `strain` say it in MLSForceField's words instead.
template <class Element, class Method>
class FemForceField final : public ElementForceField<Element> {
 public:
  static constexpr std::string_view role = "FemForceField";

  Attribute<Method> method{
      this, "method", Method::large,
      "How rotations are treated: small (not at all), polar (removed at every quadrature point, "
      "exactly). The other names, known from SOFA, compute what polar does."};
  Attribute<MaterialLaw> material{
      this, "material", MaterialLaw::hooke,
      "Law between strain and stress, instead of method: as in MLSForceField."};
  Attribute<StrainMeasure> strain{this, "strain", StrainMeasure::corotated,
                                  "Strain of Hooke's law, instead of method: as in MLSForceField."};

  void configure() override {
    if (method.isSet() && (material.isSet() || strain.isSet())) {
      this->error(method, "method-twice",
                  std::string("and '") + (strain.isSet() ? "strain" : "material") +
                      "' are both given: one of them says which law holds");
    }
    if (material == MaterialLaw::stableNeoHookean && strain.isSet()) {
      this->error(strain, "strain-unused",
                  "has no meaning for material=\"stableNeoHookean\", which has its own strain",
                  "remove it, or use material=\"hooke\"");
    }
    if (method.isSet() && method != Method::small && method != Method::polar) {
      this->note("method-polar", "method=\"" + ValueTraits<Method>::print(method) +
                                     "\" computes what method=\"polar\" does");
    }
  }

 protected:
  [[nodiscard]] std::unique_ptr<ElementLaw> makeLaw() const override {
    return this->elasticLaw(material, method == Method::small ? StrainMeasure::cauchy : *strain);
  }
};

using TetrahedronFemForceField = FemForceField<LinearTetrahedron, TetrahedronMethod>;
using HexahedronFemForceField = FemForceField<TrilinearHexahedron, HexahedronMethod>;

}  // namespace stroma
