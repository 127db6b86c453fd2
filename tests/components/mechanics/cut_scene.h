// SPDX-License-Identifier: Apache-2.0
// A box of particles, with its surface riding on it, that can be cut: a scene made from text, and
// the body's tetrahedra beside it, six to a cell of the lattice, whose outer facets are the
// sampler's surface.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "components/cutting/cut_facets.h"
#include "components/cutting/cutter.h"
#include "components/mass/diagonal_mass.h"
#include "components/mechanics/mls_mapping.h"
#include "components/mechanics/volume_constraint.h"
#include "components/sampling/particle_sampler.h"
#include "components/solver/euler_explicit_solver.h"
#include "components/state/mechanical_object.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma::test {

// The closed surface around the particles, or its upper side alone, as a topology that follows
// cuts of itself.
class CutSurface final : public Topology {
 public:
  Attribute<bool> top{this, "top", false, "The upper side alone."};
  Link<Topology> body{this, "body", "Whose enclosing surface this is.", Lookup::explicitOnly};
  void bind() override { topologyRestored(); }
  void topologyChanged(const TopologyChange& change) override {
    if (&change.surface != this) return;
    for (const NewSurfaceNode& node : change.edit.nodes) positions_.push_back(node.rest);
    for (const ChangedTriangle& t : change.edit.changed)
      triangles_[static_cast<std::size_t>(t.slot)] = t.nodes;
    for (const AppendedTriangle& t : change.edit.appended) triangles_.push_back(t.nodes);
  }
  void topologyRestored() override {
    const SurfaceView closed = body->enclosingSurface();
    positions_.assign(closed.positions.begin(), closed.positions.end());
    triangles_.assign(closed.triangles.begin(), closed.triangles.end());
    if (top) keepTop();
  }
  [[nodiscard]] ConstVec3Span positions() const override { return positions_; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return triangles_; }

 private:
  void keepTop() {
    double highest = 0;
    for (const Vec3& x : positions_) highest = std::max(highest, x.z());
    std::vector<Index> number(positions_.size(), -1);
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      if (positions_[k].z() < highest) continue;
      number[k] = static_cast<Index>(kept.size());
      kept.push_back(positions_[k]);
    }
    positions_ = kept;
    std::erase_if(triangles_, [&](Triangle& t) {
      for (Index& node : t) node = number[static_cast<std::size_t>(node)];
      return std::ranges::find(t, -1) != t.end();
    });
  }
  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;
};

class Divider final : public TopologyModifier {
 public:
  Link<MechanicalState> particleState{this, "particles", "Particles.", Lookup::explicitOnly};
  Link<MechanicalState> nodeState{this, "nodes", "Nodes.", Lookup::explicitOnly};
  Link<Topology> cutSurface{this, "surface", "Triangles.", Lookup::explicitOnly};
  [[nodiscard]] MechanicalState& particles() const override { return *particleState; }
  [[nodiscard]] MechanicalState& nodes() const override { return *nodeState; }
  [[nodiscard]] Topology& surface() const override { return *cutSurface; }
  // The scene knows the barrier: see CutScene::check().
  [[nodiscard]] TopologyCheck check() const override { throw std::logic_error("not asked"); }
  void replay(StateReader&) override {}
};

// Tetrahedra of the box [0, n]; the sampler's surface nodes first.
inline SimplicialComplex boxSolid(const std::array<Index, 3>& n, SurfaceView surface) {
  std::vector<Vec3> points(surface.positions.begin(), surface.positions.end());
  std::map<std::array<Index, 3>, Index> number;
  const auto keyOf = [](const Vec3& x) {
    return std::array<Index, 3>{static_cast<Index>(std::lround(x[0])),
                                static_cast<Index>(std::lround(x[1])),
                                static_cast<Index>(std::lround(x[2]))};
  };
  for (std::size_t k = 0; k < points.size(); ++k) number[keyOf(points[k])] = static_cast<Index>(k);
  const auto id = [&](const std::array<Index, 3>& at) {
    const auto [entry, isNew] = number.try_emplace(at, static_cast<Index>(points.size()));
    if (isNew) points.emplace_back(at[0], at[1], at[2]);
    return entry->second;
  };
  std::vector<Tetrahedron> tetrahedra;
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (Index z = 0; z < n[2]; ++z)
    for (Index y = 0; y < n[1]; ++y)
      for (Index x = 0; x < n[0]; ++x)
        for (const auto& order : orders) {
          std::array<Index, 3> c{x, y, z};
          Tetrahedron t{id(c), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++c[static_cast<std::size_t>(order[s])];
            t[s + 1] = id(c);
          }
          tetrahedra.push_back(t);
        }
  return SimplicialComplex::fromTetrahedra(points, tetrahedra, surface.triangles);
}

struct CutSceneOptions {
  std::array<Index, 3> n = {9, 9, 9};
  std::string force = "gradient=\"consistent\"";  // attributes of the force field
  std::string mapping;
  std::string more;  // in the particles' node
  double jitter = 0.3;
  bool sheet = false;  // what is cut is the upper side alone, an open sheet on the particles
};

// The spacing is 1 m, Young's modulus 1000 Pa.
struct CutScene {
  Scene scene;
  MLSForceField* field = nullptr;
  MLSMapping* mapping = nullptr;
  MechanicalState* particles = nullptr;
  MechanicalState* nodes = nullptr;
  Divider* divider = nullptr;
  std::unique_ptr<SimplicialComplex> complex;
  std::unique_ptr<Cutter> cutter;
  CutFacets barrier{1};
  Index changes = 0;
  std::function<void(const TopologyChange&)> apply;  // in place of Scene::changeTopology

  explicit CutScene(
      const CutSceneOptions& options,
      const std::function<void(Registry&)>& addMore = [](Registry&) {})
      : scene(quiet()) {
    Registry& registry = scene.registry();
    registry.add<ParticleSampler>("ParticleSampler");
    registry.add<MechanicalObject>("MechanicalObject");
    registry.add<DiagonalMass>("DiagonalMass");
    registry.add<EulerExplicitSolver>("EulerExplicitSolver");
    registry.add<MLSForceField>("MLSForceField");
    registry.add<MLSMapping>("MLSMapping");
    registry.add<VolumeConstraint>("VolumeConstraint");
    registry.add<CutSurface>("CutSurface");
    registry.add<Divider>("Divider");
    addMore(registry);
    std::ostringstream xml;
    const auto& n = options.n;
    xml << "<Node dt=\"0.001\" gravity=\"0 0 0\"><EulerExplicitSolver substeps=\"1\"/>"
        << "<ParticleSampler name=\"sampler\" layout=\"lattice\" n=\"" << n[0] << " " << n[1] << " "
        << n[2] << "\" min=\"0 0 0\" max=\"" << n[0] << " " << n[1] << " " << n[2] << "\" jitter=\""
        << options.jitter
        << "\"/><MechanicalObject name=\"state\"/><DiagonalMass massDensity=\"1000\"/>"
        << "<MLSForceField name=\"field\" youngModulus=\"1000\" poissonRatio=\"0.3\" "
        << options.force << "/>" << options.more
        << "<Node name=\"surface\"><CutSurface name=\"mesh\" body=\"@../sampler\" top=\""
        << (options.sheet ? "true" : "false") << "\"/>"
        << "<MechanicalObject name=\"nodes\"/><MLSMapping " << options.mapping << "/></Node>"
        << "<Divider particles=\"@state\" nodes=\"@surface/nodes\" surface=\"@surface/mesh\"/>"
        << "</Node>";
    const bool ready = scene.loadText(xml.str(), "cut.xml") && scene.initialise();
    EXPECT_TRUE(ready) << scene.diagnostics().text();
    if (!ready) throw std::runtime_error("the scene cannot be made");
    field = collect<MLSForceField>(scene.root()).front();
    divider = collect<Divider>(scene.root()).front();
    particles = &divider->particles();
    nodes = &divider->nodes();
    for (MLSMapping* m : collect<MLSMapping>(scene.root()))
      if (&m->output() == nodes) mapping = m;
    makeWhole(options.n, options.sheet);
  }

  static SceneOptions quiet() {
    SceneOptions options;
    options.pluginFolders.clear();
    options.writesOutput = false;
    return options;
  }
  // The tetrahedra, and nothing cut.
  void makeWhole(const std::array<Index, 3>& n, bool sheet = false) {
    const Topology& surface = divider->surface();
    complex = std::make_unique<SimplicialComplex>(
        sheet ? SimplicialComplex::fromTriangles(surface.positions(), surface.triangles())
              : boxSolid(n, {surface.positions(), surface.triangles()}));
    cutter = std::make_unique<Cutter>(*complex, 1.0);
    barrier = CutFacets(1);
  }

  // Sweeps a blade, a straight edge, through these poses.
  using Pose = std::array<Vec3, 2>;
  void cut(const std::vector<Pose>& poses) {
    for (std::size_t k = 0; k < poses.size(); ++k) {
      std::vector<Vec3> blade;
      constexpr int pieces = 20;
      for (int p = 0; p <= pieces; ++p)
        blade.push_back(poses[k][0] + (poses[k][1] - poses[k][0]) * p / pieces);
      follow(k + 1 < poses.size() ? cutter->advance(blade) : cutter->finish(blade));
    }
  }
  void follow(const SurfaceEdit& edit) {
    if (edit.empty()) return;
    barrier.add(edit.cutFacets);
    LinkEnergy energy;  // asked for, as a modifier does
    const TopologyChange change{*particles, *nodes, divider->surface(), edit, barrier, &energy};
    if (apply)
      apply(change);
    else
      scene.changeTopology(change);
    ++changes;
  }

  [[nodiscard]] std::vector<Vec3> forces(ConstVec3Span x) const {
    std::vector<Vec3> f(x.size(), Vec3::Zero()), v(x.size(), Vec3::Zero());
    field->addForce({x, v, 0}, f);
    return f;
  }
  [[nodiscard]] double energy(ConstVec3Span x) const { return field->potentialEnergy({x, x, 0}); }
  [[nodiscard]] TopologyCheck check() const {
    TopologyCheck result{*particles, *nodes, divider->surface(), barrier, 0, {}};
    scene.checkTopology(result);
    return result;
  }
};

// Blades that come from above (+z) in the plane x = at, tilted by `tilt` in x per z, from y0 to y1,
// down to the given depth.
inline std::vector<CutScene::Pose> slit(const std::array<Index, 3>& n, double at, double tilt,
                                        double y0, double y1, double depth) {
  std::vector<CutScene::Pose> poses;
  const double top = n[2] + 0.3;
  const int steps = std::max(2, static_cast<int>(std::ceil((depth + 0.3) / 0.5)));
  for (int k = 0; k <= steps; ++k) {
    const double z = top - (depth + 0.3) * k / steps, x = at + tilt * (z - n[2] / 2.0);
    poses.push_back({Vec3(x, y0, z), Vec3(x, y1, z)});
  }
  return poses;
}

}  // namespace stroma::test
