// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "components/fem/element_law.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/stress_field.h"

namespace stroma {

// Finite elements between the particles of a state: what all of them have in common. Which law
// holds is for the derived class to say. Elements are those of the topology, at rest at the state's
// rest positions; all must have a positive volume. They do not follow cuts.
template <class Element>
class ElementForceField : public ForceField, public StressField {
 public:
  static constexpr std::string_view role = "ElementForceField";

  Attribute<double> youngModulus{this,
                                 "youngModulus",
                                 5000.0,
                                 "Young's modulus.",
                                 {.unit = "Pa", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> poissonRatio{
      this,
      "poissonRatio",
      0.45,
      "Poisson's ratio.",
      {.min = -1, .max = 0.5, .exclusiveMin = true, .exclusiveMax = true, .runtime = true}};
  Attribute<TangentKind> tangent{
      this, "tangent", TangentKind::filtered,
      "Stiffness for implicit solvers: exact, or filtered to be positive "
      "semi-definite."};
  Attribute<bool> computeVonMises{this, "computeVonMisesStress", false,
                                  "Publish von Mises stress and volume ratio of the particles."};
  Attribute<std::vector<double>> vonMises{
      this,
      "vonMises",
      {},
      "Von Mises stress of each particle: of the mean stress of its elements.",
      {.unit = "Pa", .output = true}};
  Attribute<std::vector<double>> volumeRatio{this,
                                             "volumeRatio",
                                             {},
                                             "Current over reference volume around each particle.",
                                             {.output = true}};

  Link<MechanicalState> mechanicalState{
      this, "state", "Particles.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Where the elements come from.", Lookup::sameNode};

  void bind() override;
  void start() override;
  void schedule(Schedule& schedule) override;
  void attributeChanged(const AttributeBase& attribute) override;

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override { law_->addForces(at.x, f); }
  [[nodiscard]] double potentialEnergy(const StateView& at) const override {
    return law_->energy(at.x);
  }
  [[nodiscard]] Mat3 stressAt(const StateView& at, Index particle) const override {
    return law_->stressAt(at.x, particle).stress;
  }
  void linearize(const StateView& at) override { law_->prepareTangent(at.x, tangent); }
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                  double damping) const override;
  [[nodiscard]] std::vector<Index> neighboursOf(Index particle) const override;

 protected:
  [[nodiscard]] virtual std::unique_ptr<ElementLaw> makeLaw() const = 0;
  [[nodiscard]] const ElementMesh<Element>& mesh() const { return *mesh_; }
  // Hooke's law with one of the strains, or the stable neo-Hookean one.
  [[nodiscard]] std::unique_ptr<ElementLaw> elasticLaw(MaterialLaw material,
                                                       StrainMeasure strain) const;

 private:
  [[nodiscard]] bool hasSoundElements();
  void publishStress(const StepContext& step);

  std::unique_ptr<ElementMesh<Element>> mesh_;
  std::unique_ptr<ElementLaw> law_;
};

extern template class ElementForceField<LinearTetrahedron>;
extern template class ElementForceField<TrilinearHexahedron>;

}  // namespace stroma
