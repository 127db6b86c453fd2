// SPDX-License-Identifier: Apache-2.0
#include "components/fem/element_force_field.h"

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/stable_neo_hookean.h"
#include "components/material/von_mises.h"
#include "core/element_body.h"
#include "core/schedule.h"
#include "core/sorted_ids.h"

namespace stroma {

template <class Element>
bool ElementForceField<Element>::hasSoundElements() {
  const auto elements = Element::of(*topology);
  if (!checkElements(*this, topology, *mechanicalState, elements.size(), Element::plural))
    return false;
  const ElementFlaw flaw = ElementMesh<Element>::findFlaw(mechanicalState->rest(), elements);
  if (flaw.count == 0) return true;
  refuseFlaw(*this, topology, flaw, elements.size(), Element::plural,
             elements[static_cast<std::size_t>(flaw.first)], Element::order);
  return false;
}

template <class Element>
void ElementForceField<Element>::bind() {
  if (!hasSoundElements()) return;
  mesh_ = std::make_unique<ElementMesh<Element>>(mechanicalState->rest(), Element::of(*topology));
  law_ = makeLaw();
  Index loose = 0;
  for (Index i = 0; i < mesh_->nodeCount(); ++i) loose += mesh_->placesOf(i).empty();
  warnOfLooseParticles(*this, loose, mesh_->nodeCount(), "element");
  if (computeVonMises) {
    const auto particles = static_cast<std::size_t>(mesh_->nodeCount());
    vonMises.set(std::vector<double>(particles, 0.0));
    volumeRatio.set(std::vector<double>(particles, 1.0));
  }
}

template <class Element>
void ElementForceField<Element>::start() {
  refuseCuts(
      *this, *mechanicalState, *topology,
      "MLSForceField follows them; youngModulus, poissonRatio, material and strain mean the same "
      "there");
}

template <class Element>
void ElementForceField<Element>::schedule(Schedule& schedule) {
  if (*computeVonMises) {
    schedule.add<&ElementForceField::publishStress>(Stage::Guard, *this, "stress", Rate::visual);
  }
}

template <class Element>
void ElementForceField<Element>::publishStress(const StepContext&) {
  std::vector<double> stress(vonMises->size()), ratio(vonMises->size());
  const ConstVec3Span x = mechanicalState->x();
  parallelFor(mesh_->nodeCount(), [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const NodeStress at = law_->stressAt(x, i);
    stress[k] = vonMisesStress(at.stress);
    ratio[k] = at.volumeRatio;
  });
  vonMises.set(std::move(stress));
  volumeRatio.set(std::move(ratio));
}

template <class Element>
void ElementForceField<Element>::attributeChanged(const AttributeBase& attribute) {
  if (&attribute == &youngModulus || &attribute == &poissonRatio) law_ = makeLaw();
}

template <class Element>
void ElementForceField<Element>::addTangentProduct(ConstVec3Span dx, double stiffness,
                                                   double /*damping*/, Vec3Span df) const {
  // df/dx = -K; there is no dependence on velocity
  if (stiffness != 0) law_->addStiffnessProduct(-stiffness, dx, df);
}

template <class Element>
bool ElementForceField<Element>::addPattern(BlockPattern& pattern, Index offset) const {
  law_->addPattern(pattern, offset);
  return true;
}

template <class Element>
void ElementForceField<Element>::addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                                            double /*damping*/) const {
  law_->addTangent(matrix, offset, -stiffness);
}

template <class Element>
std::vector<Index> ElementForceField<Element>::neighboursOf(Index particle) const {
  std::vector<Index> neighbours;
  for (const Index place : mesh_->placesOf(particle)) {
    for (const Index node : mesh_->nodes(place / Element::nodes)) {
      if (node != particle) neighbours.push_back(node);
    }
  }
  sortUnique(neighbours);
  return neighbours;
}

template <class Element>
std::unique_ptr<ElementLaw> ElementForceField<Element>::elasticLaw(MaterialLaw material,
                                                                   StrainMeasure strain) const {
  const double E = youngModulus, nu = poissonRatio;
  if (material == MaterialLaw::stableNeoHookean)
    return makeElementLaw(StableNeoHookean(E, nu), *mesh_);
  if (strain == StrainMeasure::cauchy) return makeElementLaw(HookeCauchy(E, nu), *mesh_);
  if (strain == StrainMeasure::green) return makeElementLaw(HookeGreen(E, nu), *mesh_);
  return makeElementLaw(HookeCorotated(E, nu), *mesh_);
}

template class ElementForceField<LinearTetrahedron>;
template class ElementForceField<TrilinearHexahedron>;

}  // namespace stroma
