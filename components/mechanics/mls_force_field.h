// SPDX-License-Identifier: Apache-2.0
// Point-based elasticity as a component: total-Lagrangian moving least squares over the particles
// of a state (Mueller et al. 2004, with the force as the exact gradient of the energy), zero-energy
// control (Kugelstadt et al. 2021), gradients optionally made consistent with the surface's
// tractions.
#pragma once

#include <memory>
#include <optional>

#include "components/mechanics/consistent_gradient.h"
#include "components/mechanics/mls_bonds.h"
#include "components/mechanics/surface_shape.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/mesh.h"

namespace stroma {

enum class MaterialLaw { hooke, stableNeoHookean };
enum class StrainMeasure { cauchy, green, corotated };
enum class GradientScheme { plain, consistent, secondOrder };
enum class TangentKind { exact, filtered };

template <>
struct EnumNames<MaterialLaw> {
  static constexpr std::array<std::pair<MaterialLaw, std::string_view>, 2> names = {
      {{MaterialLaw::hooke, "hooke"}, {MaterialLaw::stableNeoHookean, "stableNeoHookean"}}};
};
template <>
struct EnumNames<StrainMeasure> {
  static constexpr std::array<std::pair<StrainMeasure, std::string_view>, 3> names = {
      {{StrainMeasure::cauchy, "cauchy"},
       {StrainMeasure::green, "green"},
       {StrainMeasure::corotated, "corotated"}}};
};
template <>
struct EnumNames<GradientScheme> {
  static constexpr std::array<std::pair<GradientScheme, std::string_view>, 3> names = {
      {{GradientScheme::plain, "plain"},
       {GradientScheme::consistent, "consistent"},
       {GradientScheme::secondOrder, "secondOrder"}}};
};
template <>
struct EnumNames<TangentKind> {
  static constexpr std::array<std::pair<TangentKind, std::string_view>, 2> names = {
      {{TangentKind::exact, "exact"}, {TangentKind::filtered, "filtered"}}};
};
template <>
struct EnumNames<SupportShape> {
  static constexpr std::array<std::pair<SupportShape, std::string_view>, 3> names = {
      {{SupportShape::ball, "ball"},
       {SupportShape::box, "box"},
       {SupportShape::ellipsoid, "ellipsoid"}}};
};
template <>
struct EnumNames<Kernel> {
  static constexpr std::array<std::pair<Kernel, std::string_view>, 3> names = {
      {{Kernel::mueller2003, "mueller2003"},
       {Kernel::wendland1995, "wendland1995"},
       {Kernel::desbrun1996, "desbrun1996"}}};
};

class MLSForceField final : public ForceField {
 public:
  static constexpr std::string_view role = "MLSForceField";

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
  Attribute<MaterialLaw> material{
      this, "material", MaterialLaw::hooke,
      "Law between strain and stress. stableNeoHookean (Smith et al. 2018) "
      "has its own strain and survives inversion."};
  Attribute<StrainMeasure> strain{
      this, "strain", StrainMeasure::corotated,
      "Strain of Hooke's law: cauchy (small rotations only), green (St. "
      "Venant-Kirchhoff; fails in strong compression), corotated."};
  Attribute<SupportShape> supportShape{this, "supportShape", SupportShape::ball,
                                       "Ball, box, or ellipsoid along the layers of thin tissue "
                                       "(needs normals and spacings)."};
  Attribute<int> supportCount{this, "supportCount", 12, "Neighbours of a particle.", {.min = 1}};
  Attribute<double> supportRadius{this,
                                  "supportRadius",
                                  0.0,
                                  "Support by radius instead of by count.",
                                  {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<double> supportSpacings{
      this,
      "supportSpacings",
      0.0,
      "Support by radius, in particle spacings; 1.6 suits ellipsoids.",
      {.min = 0, .exclusiveMin = true}};
  Attribute<double> supportReach{this,
                                 "supportReach",
                                 1.2,
                                 "Support radius over the distance of the last neighbour, when "
                                 "supported by count.",
                                 {.min = 1, .exclusiveMin = true}};
  Attribute<Kernel> kernel{this, "kernel", Kernel::mueller2003,
                           "Weight of a neighbour by distance."};
  Attribute<GradientScheme> gradient{
      this, "gradient", GradientScheme::plain,
      "plain moving least squares, consistent with surface "
      "tractions (accurate bending; needs the enclosing surface), or "
      "secondOrder (consistent, and corrected where neighbours lie "
      "on one side only; the most accurate for solids)."};
  Attribute<int> projectionIterations{
      this,
      "projectionIterations",
      8,
      "Iterations that make the gradients consistent; 0 solves exactly.",
      {.min = 0}};
  Attribute<double> zeroEnergyControl{this,
                                      "zeroEnergyControl",
                                      0.3,
                                      "Stiffness, in units of Young's modulus, against motion that "
                                      "the gradients do not see; 0 switches it off.",
                                      {.min = 0}};
  Attribute<TangentKind> tangent{
      this, "tangent", TangentKind::filtered,
      "Stiffness for implicit solvers: exact, or filtered to be positive "
      "semi-definite."};
  Attribute<int> surfaceSupport{this,
                                "surfaceSupport",
                                12,
                                "Particles that carry a surface point, in the boundary term of the "
                                "consistent gradient and in mappings that do not say otherwise.",
                                {.min = 1}};
  Attribute<std::vector<double>> volume{
      this,
      "volume",
      {},
      "Volumes of the particles, instead of the "
      "topology's.",
      {.unit = "m^3", .min = 0, .exclusiveMin = true, .autolink = true}};
  Attribute<std::vector<Vec3>> normal{this,
                                      "normal",
                                      {},
                                      "Unit normals of the layers, one a particle "
                                      "(ellipsoids).",
                                      {.autolink = true}};
  Attribute<double> spacing{this,
                            "spacing",
                            0.0,
                            "Spacing of particles along a layer (ellipsoids).",
                            {.unit = "m", .min = 0, .autolink = true}};
  Attribute<double> layerSpacing{this,
                                 "layerSpacing",
                                 0.0,
                                 "Spacing of the layers (ellipsoids).",
                                 {.unit = "m", .min = 0, .autolink = true}};
  Attribute<bool> computeVonMises{this, "computeVonMisesStress", false,
                                  "Publish von Mises stress and volume ratio of the particles."};
  Attribute<std::vector<double>> vonMises{
      this, "vonMises", {}, "Von Mises stress of each particle.", {.unit = "Pa", .output = true}};
  Attribute<std::vector<double>> volumeRatio{
      this, "volumeRatio", {}, "Current over reference volume of each particle.", {.output = true}};

  Link<MechanicalState> mechanicalState{
      this, "state", "Particles.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this,
                          "topology",
                          "Where volumes and the enclosing surface come from.",
                          Lookup::sameNode,
                          {.required = false}};
  Link<Mesh> surface{this,
                     "surface",
                     "Closed surface that the particles fill, instead of the "
                     "topology's.",
                     Lookup::explicitOnly,
                     {.required = false}};

  MLSForceField();
  ~MLSForceField() override;

  void configure() override;
  void bind() override;
  void schedule(Schedule& schedule) override;
  void attributeChanged(const AttributeBase& attribute) override;

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView& at) override;
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                  double damping) const override;

  // The discretisation, for the volume constraint and mappings of the same particles.
  [[nodiscard]] const MlsBonds& bonds() const { return *bonds_; }
  // Shape functions of surface points, the ones that the consistent gradient's boundary term uses.
  // Without triangles the points stand alone.
  [[nodiscard]] std::shared_ptr<const SurfaceShape> shapeOf(ConstVec3Span points,
                                                            std::span<const Triangle> triangles,
                                                            Index supports) const;
  [[nodiscard]] const RankReport& rankReport() const { return gradients_.report; }
  [[nodiscard]] const std::optional<ProjectionReport>& projectionReport() const {
    return projection_;
  }

 private:
  class Law;  // the force loops for one material
  template <class Material>
  class LawOf;

  [[nodiscard]] double particleSpacing() const;
  [[nodiscard]] bool readVolumes();
  [[nodiscard]] bool findSupports();
  void makeGradientsConsistent();
  void warnOfCoarseSurface();
  void reportRanks();
  void buildBonds();
  [[nodiscard]] std::unique_ptr<Law> makeLaw() const;
  void publishStress(const StepContext& step);

  std::vector<double> volumes_;  // weights of the energy's sum; the cells' unless secondOrder
  Neighbourhoods neighbourhoods_;
  TransposedRows transposed_;
  Gradients gradients_;       // the ones forces use
  Gradients plainGradients_;  // those of the shape functions, when they differ
  SurfaceView closed_{};      // the surface of the boundary term, and its shape functions
  std::shared_ptr<const SurfaceShape> boundaryShape_;
  std::optional<ProjectionReport> projection_;
  std::unique_ptr<MlsBonds> bonds_;
  std::unique_ptr<Law> law_;
};

}  // namespace stroma
