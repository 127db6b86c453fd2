// SPDX-License-Identifier: Apache-2.0
#include "components/fem/hyperelastic_force_field.h"

#include "components/material/hooke_green.h"
#include "components/material/neo_hookean.h"
#include "components/material/stable_neo_hookean.h"

namespace stroma {
namespace {

struct ElasticPair {
  double youngModulus, poissonRatio;
};

ElasticPair fromLame(double mu, double lambda) {
  return {mu * (3 * lambda + 2 * mu) / (lambda + mu), lambda / (2 * (lambda + mu))};
}

// Why two moduli are not those of a solid that resists every strain; empty if they are.
std::string moduliProblem(HyperelasticLaw law, const std::vector<double>& moduli) {
  if (moduli.size() != 2) {
    return "needs two values for materialName=\"" + ValueTraits<HyperelasticLaw>::print(law) +
           "\", has " + std::to_string(moduli.size());
  }
  if (!(moduli[0] > 0)) return "has a shear modulus that is not positive";
  const bool direct = law == HyperelasticLaw::NeoHookean;
  const double bulk = direct ? moduli[1] : moduli[1] + 2 * moduli[0] / 3;
  if (bulk > 0) return {};
  return direct ? "has a bulk modulus that is not positive"
                : "has a bulk modulus, lambda + 2/3 mu, that is not positive";
}

}  // namespace

void TetrahedronHyperelasticityForceField::configure() {
  const bool byYoung = youngModulus.isSet() || poissonRatio.isSet();
  if (parameterSet.isSet() == byYoung) {
    error("attr-required", std::string("needs either 'ParameterSet' or 'youngModulus' and "
                                       "'poissonRatio'") +
                               (byYoung ? ", not both" : ""));
  } else if (byYoung && !(youngModulus.isSet() && poissonRatio.isSet())) {
    error("attr-required", std::string("needs '") +
                               (youngModulus.isSet() ? "poissonRatio" : "youngModulus") +
                               "' as well");
  }
}

void TetrahedronHyperelasticityForceField::bind() {
  if (parameterSet.isSet()) {
    const std::string problem = moduliProblem(materialName, parameterSet);
    if (!problem.empty()) {
      error(parameterSet, "material-moduli", problem);
      return;
    }
  }
  ElementForceField::bind();
}

std::unique_ptr<ElementLaw> TetrahedronHyperelasticityForceField::makeLaw() const {
  ElasticPair pair{youngModulus, poissonRatio};
  if (parameterSet.isSet()) {
    const double mu = (*parameterSet)[0], second = (*parameterSet)[1];
    if (materialName == HyperelasticLaw::NeoHookean)
      return makeElementLaw(NeoHookean(NeoHookean::Moduli{mu, second}), mesh());
    pair = fromLame(mu, second);
  }
  const auto [E, nu] = pair;
  switch (*materialName) {
    case HyperelasticLaw::StVenantKirchhoff:
      return makeElementLaw(HookeGreen(E, nu), mesh());
    case HyperelasticLaw::NeoHookean:
      return makeElementLaw(NeoHookean(E, nu), mesh());
    case HyperelasticLaw::StableNeoHookean:
      break;
  }
  return makeElementLaw(StableNeoHookean(E, nu, StableNeoHookean::Form::classic), mesh());
}

}  // namespace stroma
