// SPDX-License-Identifier: Apache-2.0
// Random cuts through whole bodies as scenes have them: tetrahedra, particles, links and surface
// nodes follow, nothing moves. What must hold is checked after the changes; links and supports are
// asked against all facets one by one.
#pragma once

#include <chrono>

#include "components/mechanics/mls_mapping.h"
#include "core/scene.h"
#include "core/traverse.h"
#include "tests/components/cutting/random_cuts.h"

namespace stroma::test {

// Makes the changes that a test gives it.
class RandomDivider final : public TopologyModifier {
 public:
  Link<MechanicalState> particleState{this, "particles", "Particles.", Lookup::explicitOnly};
  Link<MechanicalState> nodeState{this, "nodes", "Nodes.", Lookup::explicitOnly};
  Link<Topology> cutSurface{this, "surface", "Triangles.", Lookup::explicitOnly};
  Link<Mesh> solid{this, "solid", "Tetrahedra.", Lookup::explicitOnly};

  void start() override { topologyRestored(); }
  void topologyRestored() override;
  // False when nothing has changed.
  bool change(const SurfaceEdit& edit);
  [[nodiscard]] TopologyCheck check() const override;
  void replay(StateReader&) override {}
  [[nodiscard]] MechanicalState& particles() const override { return *particleState; }
  [[nodiscard]] MechanicalState& nodes() const override { return *nodeState; }
  [[nodiscard]] Topology& surface() const override { return *cutSurface; }

  std::unique_ptr<SimplicialComplex> complex;
  std::unique_ptr<Cutter> cutter;
  std::unique_ptr<CutFacets> facets;
  std::vector<Vec3> eyes;     // from where a node looks for what carries it
  std::vector<char> retired;  // a node each
  double volume = 0;
};

struct BodyTotals {
  long cuts = 0, bodies = 0, changes = 0, checks = 0, links = 0, supports = 0, facets = 0,
       chips = 0, few = 0;
  double slivers = 0, angle = 180, seconds = 0;
};

struct BodyEffort {
  int checkEvery = 1;  // all components' checks after so many changes, and after every cut
  Index askEvery = 1;  // so many particles and nodes after every cut; others in turn
};

// One random cut for each seed, 10 to 25 of them through one body, which is then made whole again.
BodyTotals cutBodies(const std::string& sceneText, unsigned first, unsigned count,
                     const BodyEffort& effort);

// The cornea with 1,500 particles, the liver-like body with 3,024.
[[nodiscard]] std::string corneaToDivide();
[[nodiscard]] std::string liverToDivide();

}  // namespace stroma::test
