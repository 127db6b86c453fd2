// SPDX-License-Identifier: Apache-2.0
// Point-based elasticity as a component: total-Lagrangian moving least squares over the particles
// of a state (Mueller et al. 2004, with the force as the exact gradient of the energy), zero-energy
// control (Kugelstadt et al. 2021), gradients optionally made consistent with the surface's
// tractions.
//
// When the body is cut, particles keep their places and numbers; links that a cut blocks are
// replaced by what can be seen (visibility.h), and the rows concerned are fitted again. Consistent
// gradients are projected anew in two rings around them, with the walls of the incision in the
// boundary term, where the surface that is cut is the one that encloses the particles; otherwise
// (an open sheet over a shell of particles) these rows stay plain. Rows that secondOrder had
// refitted become first-order ones beside a cut; the weights of the energy's sum stay.
#pragma once

#include <memory>
#include <optional>

#include "components/material/elastic_law.h"
#include "components/mechanics/consistent_gradient.h"
#include "components/mechanics/mls_bonds.h"
#include "components/mechanics/riding_points.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/stress_field.h"
#include "core/interfaces/topology_modifier.h"

namespace stroma {

enum class GradientScheme { plain, consistent, secondOrder };

template <>
struct EnumNames<GradientScheme> {
  static constexpr std::array<std::pair<GradientScheme, std::string_view>, 3> names = {
      {{GradientScheme::plain, "plain"},
       {GradientScheme::consistent, "consistent"},
       {GradientScheme::secondOrder, "secondOrder"}}};
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

class MLSForceField final : public ForceField, public StressField {
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

  Limiter freeChips{this, "freeChips",
                    "particles with fewer than 8 neighbours on their own side of the cuts"};
  Limiter plainRows{
      this, "plainRows",
      "times that a particle beside a cut kept its plain gradient, which could not be "
      "made consistent"};

  MLSForceField();
  ~MLSForceField() override;

  void configure() override;
  void bind() override;
  void start() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void checkTopology(TopologyCheck& check) const override;
  void schedule(Schedule& schedule) override;
  void attributeChanged(const AttributeBase& attribute) override;

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  [[nodiscard]] Mat3 stressAt(const StateView& at, Index particle) const override;
  void linearize(const StateView& at) override;
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                  double damping) const override;
  [[nodiscard]] std::vector<Index> neighboursOf(Index particle) const override;

  // The discretisation, for the volume constraint and mappings of the same particles.
  [[nodiscard]] const MlsBonds& bonds() const { return *bonds_; }
  [[nodiscard]] const Neighbourhoods& neighbourhoods() const { return neighbourhoods_; }
  // Shape functions of surface points. For the surface of the consistent gradient's boundary term
  // they are the ones used there, shared. Without triangles the points stand alone.
  [[nodiscard]] std::shared_ptr<RidingPoints> shapeOf(ConstVec3Span points,
                                                      std::span<const Triangle> triangles,
                                                      Index supports) const;
  [[nodiscard]] const RankReport& rankReport() const { return gradients_.report; }
  [[nodiscard]] const std::optional<ProjectionReport>& projectionReport() const {
    return projection_;
  }
  // Of the last cut; null where nothing was projected.
  [[nodiscard]] const ProjectionReport* cutProjectionReport() const {
    return cut_ && cut_->projection ? &*cut_->projection : nullptr;
  }

  // Who divides these particles, or null; known from start() on.
  [[nodiscard]] const TopologyModifier* modifier() const { return cut_ ? cut_->modifier : nullptr; }
  // The particles as the last change has left them. Only with a modifier.
  [[nodiscard]] CutParticles cutParticles() const;
  // The stiffness (Pa) of a penalty on the particles' volumes, evaluated with the material; it must
  // live as long as this, and changeLaw() be called when it changes.
  void addVolumeStiffness(const Attribute<double>& stiffness);
  void changeLaw();
  // Lets points follow the change that topologyChanged() has just followed; `cut` as in
  // concernedPoints(). Does nothing for points that have followed it already.
  void follow(RidingPoints& points, ConstVec3Span rest, bool cut, const TopologyChange& change);

 private:
  class Law;  // the force loops for one material
  template <class Material>
  class LawOf;

  // What is kept to follow cuts.
  struct Cut {
    Cut(const TopologyModifier& by, ConstVec3Span X, const Neighbourhoods& n)
        : modifier(&by), search(X, n), chips(X.size(), 0) {
      for (const Row& row : n.rows) fewest.push_back(std::min(row.size, fewestLinks));
    }
    const TopologyModifier* modifier;
    VisibilitySearch search;
    bool followsBoundary = false;     // the surface of the boundary term is the one that is cut
    std::vector<Triangle> triangles;  // of that surface
    std::vector<Index> fewest;        // neighbours without which a particle is part of a chip
    std::vector<char> chips;          // particles with fewer
    FacetBoxes newFacets{{}};         // of the last change
    std::vector<Index> relinked;      // rows that the last change has replaced
    std::uint64_t changes = 0;        // their number so far
    std::optional<ProjectionReport> projection;  // of the last change
  };

  [[nodiscard]] double cellSide() const;  // of a cube with the mean volume of the particles (m)
  [[nodiscard]] double particleSpacing() const;
  [[nodiscard]] bool build();
  [[nodiscard]] bool readVolumes();
  [[nodiscard]] bool findSupports();
  [[nodiscard]] bool makeGradientsConsistent();
  void warnOfCoarseSurface();
  void reportBoundary();
  void reportRanks();
  void buildBonds();
  [[nodiscard]] std::unique_ptr<Law> makeLaw() const;
  template <class Material>
  [[nodiscard]] std::unique_ptr<Law> lawOf(const Material& material) const;
  void publishStress(const StepContext& step);

  [[nodiscard]] const Gradients& plainGradients() const {
    return plainGradients_.values.empty() ? gradients_ : plainGradients_;
  }
  [[nodiscard]] double energyOf(std::span<const Index> particles) const;
  [[nodiscard]] std::vector<Index> relinkRows(const CutBarrier& barrier);
  void fitRelinkedRow(Index i, const CutBarrier& barrier);
  void followBoundary(const TopologyChange& change);
  [[nodiscard]] std::vector<Index> projectAround(std::span<const Index> rows);
  void checkRow(Index i, const CutBarrier& barrier, Failures& failures) const;

  std::vector<double> volumes_;  // weights of the energy's sum; the cells' unless secondOrder
  bool irregular_ = false;       // too much so for the weights of secondOrder
  Neighbourhoods neighbourhoods_;
  TransposedRows transposed_;
  Gradients gradients_;         // the ones forces use
  Gradients plainGradients_;    // those of the shape functions, when they differ
  std::vector<Vec3> refitted_;  // those of secondOrder before they were made consistent
  SurfaceView closed_{};        // the surface of the boundary term, and its shape functions
  std::shared_ptr<RidingPoints> boundaryShape_;
  std::vector<Vec3> areas_;     // vector area of each node of that surface, m^2
  std::vector<Vec3> boundary_;  // b of the consistent gradient
  std::optional<ProjectionReport> projection_;
  std::unique_ptr<MlsBonds> bonds_;
  std::unique_ptr<Law> law_;
  std::vector<const Attribute<double>*> volumeStiffness_;
  std::unique_ptr<Cut> cut_;
};

}  // namespace stroma
