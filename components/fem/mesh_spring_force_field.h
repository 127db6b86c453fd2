// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>

#include "components/fem/element_force_field.h"
#include "components/fem/mesh_springs.h"

namespace stroma {

// Springs between the nodes of each element of a topology, all pairs of them: edges of triangles
// and tetrahedra, also the diagonals of quads and hexahedra. A pair has one spring however many
// elements share it: of the first kind of element, in the order of the attributes, that has a
// stiffness or a damping. As in SOFA the stiffness is that of the material of a spring: its
// constant is stiffness over rest length, so that halves of an edge are together as stiff as the
// whole; damping likewise. The elements do not follow cuts.
class MeshSpringForceField final : public ForceField {
 public:
  static constexpr std::string_view role = "MeshSpringForceField";

  Attribute<double> stiffness{this,
                              "stiffness",
                              0.0,
                              "Force per strain of the springs of every kind of element that has "
                              "no stiffness of its own below.",
                              {.unit = "N", .min = 0}};
  Attribute<double> damping{this,
                            "damping",
                            0.0,
                            "Force per rate of strain, of every kind that has no damping of its "
                            "own below.",
                            {.unit = "N s", .min = 0}};
  Attribute<double> linesStiffness{
      this, "linesStiffness", 0.0, "Stiffness of the edges.", {.unit = "N", .min = 0}};
  Attribute<double> linesDamping{
      this, "linesDamping", 0.0, "Damping of the edges.", {.unit = "N s", .min = 0}};
  Attribute<double> trianglesStiffness{
      this, "trianglesStiffness", 0.0, "Stiffness of the triangles.", {.unit = "N", .min = 0}};
  Attribute<double> trianglesDamping{
      this, "trianglesDamping", 0.0, "Damping of the triangles.", {.unit = "N s", .min = 0}};
  Attribute<double> quadsStiffness{
      this, "quadsStiffness", 0.0, "Stiffness of the quads.", {.unit = "N", .min = 0}};
  Attribute<double> quadsDamping{
      this, "quadsDamping", 0.0, "Damping of the quads.", {.unit = "N s", .min = 0}};
  Attribute<double> tetrahedraStiffness{this,
                                        "tetrahedraStiffness",
                                        0.0,
                                        "Stiffness of the tetrahedra.",
                                        {.unit = "N", .min = 0, .aliases = "tetrasStiffness"}};
  Attribute<double> tetrahedraDamping{this,
                                      "tetrahedraDamping",
                                      0.0,
                                      "Damping of the tetrahedra.",
                                      {.unit = "N s", .min = 0, .aliases = "tetrasDamping"}};
  Attribute<double> cubesStiffness{
      this, "cubesStiffness", 0.0, "Stiffness of the hexahedra.", {.unit = "N", .min = 0}};
  Attribute<double> cubesDamping{
      this, "cubesDamping", 0.0, "Damping of the hexahedra.", {.unit = "N s", .min = 0}};
  Attribute<bool> noCompression{this, "noCompression", false,
                                "Springs shorter than at rest exert no force."};
  Attribute<TangentKind> tangent{
      this, "tangent", TangentKind::filtered,
      "Stiffness for implicit solvers: exact, or filtered to be positive semi-definite."};
  Attribute<int> springCount{this, "springCount", 0, "Number of springs.", {.output = true}};

  Link<MechanicalState> mechanicalState{
      this, "state", "Particles.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Where the elements come from.", Lookup::sameNode};

  void configure() override;
  void bind() override;
  void start() override;

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override { springs_->addForces(at.x, at.v, f); }
  [[nodiscard]] double potentialEnergy(const StateView& at) const override {
    return springs_->energy(at.x);
  }
  void linearize(const StateView& at) override {
    springs_->prepareTangent(at.x, tangent == TangentKind::filtered);
  }
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double dampingFactor,
                         Vec3Span df) const override {
    springs_->addTangentProduct(dx, stiffnessFactor, dampingFactor, df);
  }
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override {
    springs_->addPattern(pattern, offset);
    return true;
  }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffnessFactor,
                  double dampingFactor) const override {
    springs_->addTangent(matrix, offset, stiffnessFactor, dampingFactor);
  }

 private:
  // Stiffness and damping of one kind of element.
  struct Kind {
    const Attribute<double>& stiffness;
    const Attribute<double>& damping;
  };
  [[nodiscard]] std::array<Kind, 5> kinds() const;
  template <std::size_t N>
  void connect(const Kind& kind, std::span<const std::array<Index, N>> elements,
               std::set<Edge>& known, std::vector<Spring>& springs) const;

  std::unique_ptr<MeshSprings> springs_;
};

}  // namespace stroma
