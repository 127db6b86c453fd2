// SPDX-License-Identifier: Apache-2.0
// A block of tissue, 12 x 12 x 8 mm, held at the bottom, with its tetrahedra and a surface that
// rides on 144 particles; and scalpels, mere lines that hang from a script.
#pragma once

#include <gtest/gtest.h>

#include <sstream>

#include "components/cutting/cutting_resistance.h"
#include "core/scene.h"
#include "core/traverse.h"
#include "tests/components/cutting/test_bodies.h"

namespace stroma::test {

inline std::string printed(ConstVec3Span points) {
  std::ostringstream out;
  out.precision(17);
  for (const Vec3& p : points) out << p.x() << ' ' << p.y() << ' ' << p.z() << "  ";
  return out.str();
}

template <class Element>
std::string printed(std::span<const Element> elements) {
  std::ostringstream out;
  for (const Element& e : elements)
    for (const Index i : e) out << i << ' ';
  return out.str();
}

// The block's surface and tetrahedra as two topologies.
struct BlockMeshes {
  std::string surface, solid;
  BlockMeshes() {
    const TetrahedralMesh mesh = block(Vec3(12e-3, 12e-3, 8e-3), {6, 6, 4}, 0.1, 1);
    const SimplicialComplex bare = SimplicialComplex::fromTetrahedra(mesh.points, mesh.tetrahedra);
    // the surface's nodes come first
    std::vector<Vec3> points = bare.nodePositions();
    std::vector<Index> number(mesh.points.size(), -1);
    for (Index n = 0; n < bare.nodeCount(); ++n)
      number[static_cast<std::size_t>(bare.nodeVertex(n))] = n;
    surface =
        R"(position=")" + printed(points) + R"(" triangles=")" + printed(bare.surface()) + '"';
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] >= 0) continue;
      number[v] = static_cast<Index>(points.size());
      points.push_back(mesh.points[v]);
    }
    std::vector<Tetrahedron> tetrahedra = mesh.tetrahedra;
    for (Tetrahedron& t : tetrahedra)
      for (Index& i : t) i = number[static_cast<std::size_t>(i)];
    solid = R"(position=")" + printed(points) + R"(" tetrahedra=")" +
            printed(std::span<const Tetrahedron>(tetrahedra)) + '"';
  }
};

// Key times in s, positions of the tip in mm; `more`: attributes of the device.
inline std::string scalpel(const std::string& name, const std::string& times,
                           const std::string& positions, const std::string& more = "") {
  return "<ScriptedDevice name=\"hand_" + name + "\" keyTimes=\"" + times + "\" positions=\"" +
         positions + " mm\" " + more + "/><ScalpelTool name=\"" + name + "\" device=\"@hand_" +
         name + "\" length=\"20 mm\" sampleCount=\"3\"/>";
}

struct BlockOptions {
  std::string tools, cut = "", contact = "";  // attributes of the modifier; components of the body
  std::string young = "10 kPa";
  std::string names = "@/scalpel";
};

struct CutBlock {
  Scene scene;
  CuttingTopologyModifier* cut = nullptr;

  explicit CutBlock(const BlockOptions& o) : scene(options()) {
    static const BlockMeshes meshes;
    scene.registry().add<CuttingTopologyModifier>("CuttingTopologyModifier");
    scene.registry().add<CuttingResistance>("CuttingResistance");
    const std::string text =
        R"(<Node dt="1 ms" gravity="0 0 0"><DefaultAnimationLoop/>)" + o.tools +
        R"(<Node name="body"><EulerImplicitSolver/><SparseLDLSolver/>
        <ParticleSampler name="particles" layout="lattice" n="6 6 4" min="0 0 0" max="12 12 8 mm"/>
        <MechanicalObject name="state" src="@particles"/><DiagonalMass massDensity="1000"/>
        <MLSForceField name="elasticity" src="@particles" youngModulus=")" +
        o.young + R"(" poissonRatio="0.3" gradient="consistent"/>
        <BoxROI name="bottom" box="-1 -1 -1 1 1 0.0015"/>
        <FixedProjectiveConstraint indices="@bottom.indices"/>
        <Node name="surface"><MeshTopology name="mesh" )" +
        meshes.surface + R"(/><MechanicalObject name="nodes"/><MLSMapping/></Node>
        <Node name="inside"><MeshTopology name="solid" )" +
        meshes.solid + R"(/></Node>
        <CuttingTopologyModifier name="cut" tools=")" +
        o.names +
        R"(" solid="@inside/solid" surfaceState="@surface/nodes" topology="@surface/mesh" )" +
        o.cut + "/>" + o.contact + "</Node></Node>";
    const bool good = scene.loadText(text, "block.xml") && scene.initialise();
    EXPECT_TRUE(good) << scene.diagnostics().text();
    if (!good) throw std::runtime_error("the scene cannot be made");
    cut = collect<CuttingTopologyModifier>(scene.root()).front();
  }
  static SceneOptions options() {
    SceneOptions options;
    options.pluginFolders = {STROMA_MODULES_FOLDER};
    options.writesOutput = false;
    return options;
  }

  void step() { ASSERT_TRUE(scene.step()) << scene.divergence()->message; }
  // To the step that ends at this time (s).
  void advanceTo(double time) {
    const auto last = static_cast<std::uint64_t>(time / scene.dt() + 0.5);
    while (scene.stepCount() < last) ASSERT_NO_FATAL_FAILURE(step());
    for (const std::string& failure : cut->check().failures) ADD_FAILURE() << failure;
  }
  [[nodiscard]] Tool& tool(std::size_t k = 0) { return *collect<Tool>(scene.root()).at(k); }
  [[nodiscard]] std::uint64_t count(const std::string& limiter) const {
    for (const Limiter* l : cut->limiters())
      if (l->name() == limiter) return l->count();
    ADD_FAILURE() << "no limiter " << limiter;
    return 0;
  }
  [[nodiscard]] Index pieces() const {
    Index n = 1;
    static_cast<void>(cut->complex().pieces(n));
    return n;
  }
};

}  // namespace stroma::test
