// SPDX-License-Identifier: Apache-2.0
// The force loops of one kind of element behind calls that do not name the material: one virtual
// call a step, none per element.
#pragma once

#include <memory>

#include "components/fem/element_elasticity.h"
#include "core/block_matrix.h"

namespace stroma {

class ElementLaw {
 public:
  virtual ~ElementLaw() = default;
  virtual void addForces(ConstVec3Span x, Vec3Span f) = 0;
  [[nodiscard]] virtual double energy(ConstVec3Span x) const = 0;
  virtual void prepareTangent(ConstVec3Span x, TangentKind kind) = 0;
  // df += factor K dx
  virtual void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) const = 0;
  virtual void addPattern(BlockPattern& pattern, Index offset) const = 0;
  // matrix += factor K
  virtual void addTangent(BlockMatrix& matrix, Index offset, double factor) const = 0;
  [[nodiscard]] virtual NodeStress stressAt(ConstVec3Span x, Index node) const = 0;
};

template <class Element, class Material>
class ElementLawOf final : public ElementLaw {
 public:
  ElementLawOf(const Material& material, const ElementMesh<Element>& mesh)
      : elasticity_(material, mesh) {}
  void addForces(ConstVec3Span x, Vec3Span f) override { elasticity_.addForces(x, f); }
  [[nodiscard]] double energy(ConstVec3Span x) const override { return elasticity_.energy(x); }
  void prepareTangent(ConstVec3Span x, TangentKind kind) override {
    elasticity_.prepareTangent(x, kind);
  }
  void addPattern(BlockPattern& pattern, Index offset) const override {
    elasticity_.stiffness().addPattern(pattern, offset);
  }
  void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) const override {
    elasticity_.addStiffnessProduct(factor, dx, df);
  }
  void addTangent(BlockMatrix& matrix, Index offset, double factor) const override {
    elasticity_.stiffness().addTo(matrix, offset, factor);
  }
  [[nodiscard]] NodeStress stressAt(ConstVec3Span x, Index node) const override {
    return elasticity_.stressAt(x, node);
  }

 private:
  ElementElasticity<Element, Material> elasticity_;
};

template <class Element, class Material>
[[nodiscard]] std::unique_ptr<ElementLaw> makeElementLaw(const Material& material,
                                                         const ElementMesh<Element>& mesh) {
  return std::make_unique<ElementLawOf<Element, Material>>(material, mesh);
}

}  // namespace stroma
