// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_force_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/stable_neo_hookean.h"
#include "components/material/volume_penalty.h"
#include "components/material/von_mises.h"
#include "components/mechanics/mls_elasticity.h"
#include "components/mechanics/second_order.h"
#include "core/scene.h"
#include "core/schedule.h"
#include "core/traverse.h"
#include "core/triangle.h"

namespace stroma {

class MLSForceField::Law {
 public:
  virtual ~Law() = default;
  virtual void addForces(ConstVec3Span x, Vec3Span f) = 0;
  virtual double energy(ConstVec3Span x) = 0;
  [[nodiscard]] virtual double energyOf(ConstVec3Span x,
                                        std::span<const Index> particles) const = 0;
  virtual void prepareTangent(ConstVec3Span x, TangentKind kind) = 0;
  virtual void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) = 0;
  virtual void addTangent(BlockMatrix& matrix, Index offset, double factor) const = 0;
  virtual void stress(ConstVec3Span x, std::vector<double>& vonMises,
                      std::vector<double>& volumeRatio) = 0;
  [[nodiscard]] virtual Mat3 stressAt(ConstVec3Span x, Index i) const = 0;
};

template <class Material>
class MLSForceField::LawOf final : public Law {
 public:
  LawOf(const Material& material, const MlsBonds& bonds) : elasticity_(material, bonds) {}
  void addForces(ConstVec3Span x, Vec3Span f) override { elasticity_.addForces(x, f); }
  double energy(ConstVec3Span x) override { return elasticity_.energy(x); }
  [[nodiscard]] double energyOf(ConstVec3Span x, std::span<const Index> particles) const override {
    return elasticity_.energyOf(x, particles);
  }
  void prepareTangent(ConstVec3Span x, TangentKind kind) override {
    elasticity_.prepareTangent(x, kind);
  }
  void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) override {
    elasticity_.addStiffnessProduct(factor, dx, df);
  }
  void addTangent(BlockMatrix& matrix, Index offset, double factor) const override {
    elasticity_.assembleStiffness([&](Index row, Index column, const Mat3& block) {
      matrix.add(offset + row, offset + column, factor * block);
    });
  }
  void stress(ConstVec3Span x, std::vector<double>& vonMises,
              std::vector<double>& volumeRatio) override {
    F_.resize(x.size());
    vonMises.resize(x.size());
    volumeRatio.resize(x.size());
    elasticity_.deformation(x, F_);
    parallelFor(static_cast<Index>(x.size()), [&](Index k) {
      const auto i = static_cast<std::size_t>(k);
      vonMises[i] = vonMisesStress(elasticity_.cauchyStress(F_[i]));
      volumeRatio[i] = F_[i].determinant();
    });
  }
  [[nodiscard]] Mat3 stressAt(ConstVec3Span x, Index i) const override {
    return elasticity_.stressAt(x, i);
  }

 private:
  MlsElasticity<Material> elasticity_;
  std::vector<Mat3> F_;
};

MLSForceField::MLSForceField() = default;
MLSForceField::~MLSForceField() = default;

void MLSForceField::configure() {
  if (material == MaterialLaw::stableNeoHookean && strain.isSet()) {
    error(strain, "strain-unused",
          "has no meaning for material=\"stableNeoHookean\", which has its "
          "own strain",
          "remove it, or use material=\"hooke\"");
  }
  if (supportRadius.isSet() && supportCount.isSet()) {
    error(supportRadius, "support-twice",
          "and 'supportCount' are both given: a support has one size");
  }
}

bool MLSForceField::readVolumes() {
  volumes_ = volume;
  if (volumes_.empty() && topology) {
    volumes_.assign(topology->volumes().begin(), topology->volumes().end());
  }
  const auto particles = static_cast<std::size_t>(mechanicalState->size());
  if (volumes_.size() != particles) {
    error("mls-volume",
          "knows " + std::to_string(volumes_.size()) + " volumes for " + std::to_string(particles) +
              " particles",
          "volumes come from a ParticleSampler, a RegularGridTopology, a MeshTopology's elements "
          "or 'volume'");
    return false;
  }
  const auto bad = std::ranges::find_if(volumes_, [](double v) { return !(v > 0); });
  if (bad != volumes_.end()) {
    error("mls-volume", "particle " + std::to_string(bad - volumes_.begin()) + " has no volume");
    return false;
  }
  // far below it surfaces would be sampled at points without number
  const double side = cellSide();
  if (spacing > 0.0 && spacing < 0.2 * side) {
    error(spacing, "mls-spacing",
          "is far below the side of the particles' volumes, " + ValueTraits<double>::print(side) +
              " m",
          "src=\"@sampler\" takes both from a ParticleSampler");
    return false;
  }
  return true;
}

bool MLSForceField::findSupports() {
  SupportOptions options;
  options.shape = supportShape;
  options.kernel = kernel;
  options.count = supportRadius.isSet() || supportSpacings.isSet() ? 0 : *supportCount;
  options.radius = supportSpacings.isSet() ? supportSpacings * particleSpacing() : *supportRadius;
  options.reach = supportReach;
  std::vector<EllipsoidAxes> axes;
  const ConstVec3Span X = mechanicalState->rest();
  if (options.shape == SupportShape::ellipsoid) {
    if (normal->size() != X.size() || !(spacing > 0.0) || !(layerSpacing > 0.0)) {
      error(supportShape, "support-axes",
            "=\"ellipsoid\" needs 'normal' (one a particle), 'spacing' and "
            "'layerSpacing'",
            "src=\"@sampler\" takes them from a ParticleSampler of layout=\"shell\"");
      return false;
    }
    for (const Vec3& n : *normal) {
      if (!(n.norm() > 0)) {
        error(normal, "support-axes", "has a vector of no length: each is a direction");
        return false;
      }
      axes.push_back({n.normalized(), spacing, layerSpacing});
    }
    options.radius /= *spacing;  // ellipsoids measure in spacings
  }
  // cuts then hardly ever have to move a row
  if (!collect<TopologyModifier>(scene().root()).empty()) options.spare = 6;
  neighbourhoods_ = findNeighbourhoods(X, options, axes);
  gradients_ = computeGradients(X, neighbourhoods_);
  transposed_ = transpose(neighbourhoods_);
  return true;
}

bool MLSForceField::makeGradientsConsistent() {
  closed_ = surface    ? SurfaceView{surface->positions(), surface->triangles()}
            : topology ? topology->enclosingSurface()
                       : SurfaceView{};
  if (closed_.triangles.empty()) {
    error(gradient, "gradient-surface",
          "=\"" + ValueTraits<GradientScheme>::print(gradient) +
              "\" needs the closed surface around the particles",
          "use a ParticleSampler, or give surface=\"@mesh\"");
    return false;
  }
  plainGradients_ = gradients_;
  // loads on the surface's nodes travel through the same shape functions: tractions are then exact
  boundaryShape_.reset();
  boundaryShape_ = shapeOf(closed_.positions, closed_.triangles, surfaceSupport);
  areas_.assign(closed_.positions.size(), Vec3::Zero());
  for (const Triangle& t : closed_.triangles) {
    const Vec3 area = 0.5 * cornersOf(t, closed_.positions).areaNormal();
    for (const Index node : t) areas_[static_cast<std::size_t>(node)] += area / 3;
  }
  const ConstVec3Span X = mechanicalState->rest();
  boundary_.assign(X.size(), Vec3::Zero());
  boundaryShape_->shape.addTransposed(areas_, boundary_);
  if (gradient == GradientScheme::secondOrder) {
    refitOneSided(X, neighbourhoods_, gradients_);
    auto weights = quadratureWeights(X, neighbourhoods_, transposed_, gradients_, volumes_);
    irregular_ = weights.empty();
    if (!irregular_) volumes_ = std::move(weights);
    refitted_ = gradients_.values;
  }
  ProjectionOptions options;
  options.iterations = projectionIterations;
  options.exact = projectionIterations == 0;
  try {
    projection_ =
        makeConsistent(X, neighbourhoods_, transposed_, volumes_, boundary_, gradients_, options);
  } catch (const std::runtime_error& e) {
    error(gradient, "gradient-projection", std::string("cannot be made consistent: ") + e.what());
    return false;
  }
  return true;
}

void MLSForceField::reportBoundary() {
  warnOfCoarseSurface();
  if (irregular_) {
    warning("gradient-weights",
            "the cloud is too irregular for weights of second order: the particles' volumes are "
            "used, as with gradient=\"consistent\"");
  }
  if (projection_->volumeMismatch > 1e-6) {
    warning("gradient-volume", "the particles' volumes differ from the volume of the surface by " +
                                   ValueTraits<double>::print(100 * projection_->volumeMismatch) +
                                   " %: the consistent gradient cannot be exact");
  }
}

void MLSForceField::warnOfCoarseSurface() {
  double area = 0;
  for (const Triangle& t : closed_.triangles)
    area += 0.5 * cornersOf(t, closed_.positions).areaNormal().norm();
  // edge of the equilateral triangle of mean area
  const double edge =
      std::sqrt(4 / std::sqrt(3.0) * area / static_cast<double>(closed_.triangles.size()));
  if (edge <= 2 * particleSpacing()) return;
  warning("surface-coarse",
          "the surface's triangles are " +
              ValueTraits<double>::print(std::round(10 * edge / particleSpacing()) / 10) +
              " particle spacings wide: loads are spread too widely, and bending suffers",
          "subdivide the mesh (subdivisions=\"1\" at its loader)");
}

void MLSForceField::reportRanks() {
  const RankReport& r = gradients_.report;
  if (r.coplanar + r.colinear + r.isolated == 0) return;
  warning("mls-rank", "degenerate neighbourhoods: " + std::to_string(r.coplanar) + " coplanar, " +
                          std::to_string(r.colinear) + " colinear, " + std::to_string(r.isolated) +
                          " isolated of " + std::to_string(mechanicalState->size()) +
                          " particles; they resist only in the directions their neighbours span");
}

void MLSForceField::buildBonds() {
  MlsBonds bonds(mechanicalState->rest(), neighbourhoods_, transposed_, gradients_, volumes_,
                 *zeroEnergyControl * *youngModulus);
  // in place: who has asked for bonds() keeps them
  if (bonds_) {
    *bonds_ = std::move(bonds);
  } else {
    bonds_ = std::make_unique<MlsBonds>(std::move(bonds));
  }
  law_ = makeLaw();
}

bool MLSForceField::build() {
  if (!readVolumes() || !findSupports()) return false;
  if (gradient != GradientScheme::plain && !makeGradientsConsistent()) return false;
  buildBonds();
  return true;
}

void MLSForceField::bind() {
  if (!build()) return;
  if (gradient != GradientScheme::plain) reportBoundary();
  reportRanks();
  if (computeVonMises) {
    vonMises.set(std::vector<double>(volumes_.size(), 0.0));
    volumeRatio.set(std::vector<double>(volumes_.size(), 1.0));
  }
}

template <class Material>
std::unique_ptr<MLSForceField::Law> MLSForceField::lawOf(const Material& law) const {
  double stiffness = 0;
  for (const Attribute<double>* one : volumeStiffness_) stiffness += *one;
  if (stiffness == 0) return std::make_unique<LawOf<Material>>(law, *bonds_);
  const WithVolumePenalty both(law, VolumePenalty(stiffness));
  return std::make_unique<LawOf<WithVolumePenalty<Material>>>(both, *bonds_);
}

std::unique_ptr<MLSForceField::Law> MLSForceField::makeLaw() const {
  const double E = youngModulus, nu = poissonRatio;
  if (material == MaterialLaw::stableNeoHookean) return lawOf(StableNeoHookean(E, nu));
  if (strain == StrainMeasure::cauchy) return lawOf(HookeCauchy(E, nu));
  if (strain == StrainMeasure::green) return lawOf(HookeGreen(E, nu));
  return lawOf(HookeCorotated(E, nu));
}

void MLSForceField::addVolumeStiffness(const Attribute<double>& stiffness) {
  volumeStiffness_.push_back(&stiffness);
  changeLaw();
}

void MLSForceField::changeLaw() {
  if (bonds_) law_ = makeLaw();
}

void MLSForceField::schedule(Schedule& schedule) {
  if (*computeVonMises) {
    schedule.add<&MLSForceField::publishStress>(Stage::Guard, *this, "stress", Rate::visual);
  }
}

void MLSForceField::publishStress(const StepContext&) {
  std::vector<double> stress, ratio;
  law_->stress(mechanicalState->x(), stress, ratio);
  vonMises.set(std::move(stress));
  volumeRatio.set(std::move(ratio));
}

void MLSForceField::attributeChanged(const AttributeBase& attribute) {
  if (&attribute == &youngModulus || &attribute == &poissonRatio) buildBonds();
}

void MLSForceField::addForce(const StateView& at, Vec3Span f) { law_->addForces(at.x, f); }

double MLSForceField::potentialEnergy(const StateView& at) const { return law_->energy(at.x); }

double MLSForceField::energyOf(std::span<const Index> particles) const {
  return law_->energyOf(mechanicalState->x(), particles);
}

void MLSForceField::linearize(const StateView& at) { law_->prepareTangent(at.x, tangent); }

void MLSForceField::addTangentProduct(ConstVec3Span dx, double stiffness, double /*damping*/,
                                      Vec3Span df) const {
  // df/dx = -K; there is no dependence on velocity
  if (stiffness != 0) law_->addStiffnessProduct(-stiffness, dx, df);
}

bool MLSForceField::addPattern(BlockPattern& pattern, Index offset) const {
  std::vector<Index> clique;
  for (Index i = 0; i < bonds_->particleCount(); ++i) {
    clique.assign(1, offset + i);
    for (const Index j : neighbourhoods_.neighboursOf(i)) clique.push_back(offset + j);
    pattern.addClique(clique);
  }
  return true;
}

void MLSForceField::addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                               double /*damping*/) const {
  law_->addTangent(matrix, offset, -stiffness);
}

std::vector<Index> MLSForceField::neighboursOf(Index particle) const {
  const auto row = neighbourhoods_.neighboursOf(particle);
  return {row.begin(), row.end()};
}

Mat3 MLSForceField::stressAt(const StateView& at, Index particle) const {
  return law_->stressAt(at.x, particle);
}

std::shared_ptr<RidingPoints> MLSForceField::shapeOf(ConstVec3Span points,
                                                     std::span<const Triangle> triangles,
                                                     Index supports) const {
  if (boundaryShape_ && supports == surfaceSupport &&
      std::ranges::equal(points, closed_.positions) &&
      std::ranges::equal(triangles, closed_.triangles)) {
    return boundaryShape_;
  }
  const Gradients& gradients = plainGradients();
  const ConstVec3Span X = mechanicalState->rest();
  auto riding = std::make_shared<RidingPoints>();
  riding->supports = supports;
  // samples half a particle spacing apart integrate the shape functions well
  riding->shape = triangles.empty()
                      ? SurfaceShape(X, neighbourhoods_, gradients, points, supports)
                      : SurfaceShape::ofSurface(X, neighbourhoods_, gradients, points, triangles,
                                                supports, 0.5 * particleSpacing());
  return riding;
}

double MLSForceField::cellSide() const {
  double body = 0;
  for (const double v : volumes_) body += v;
  return std::cbrt(body / static_cast<double>(volumes_.size()));
}

double MLSForceField::particleSpacing() const { return spacing > 0.0 ? *spacing : cellSide(); }

}  // namespace stroma
