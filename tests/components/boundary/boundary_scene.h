// SPDX-License-Identifier: Apache-2.0
// Scenes with supports and loads, and a mesh that is written out in the scene.
#pragma once

#include "components/boundary/grip_force_field.h"
#include "components/boundary/surface_pressure.h"
#include "components/boundary/traction_force_field.h"
#include "tests/components/solver/test_scene.h"

namespace stroma::test {

class WrittenMesh final : public Topology {
 public:
  Attribute<std::vector<Vec3>> position{this, "position", {}, "Points."};
  Attribute<std::vector<Triangle>> triangle{this, "triangles", {}, "Triangles."};
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return *triangle; }
};

// The points of every second particle of another state: enough to load a mapped state.
class EveryOther final : public Mapping {
 public:
  Link<MechanicalState> from{this, "input", "Particles.", Lookup::parent};
  Link<MechanicalState> to{this, "output", "Points.", Lookup::sameNode};
  [[nodiscard]] MechanicalState& input() const override { return *from; }
  [[nodiscard]] MechanicalState& output() const override { return *to; }
  void apply(ConstVec3Span in, Vec3Span out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = in[2 * i];
  }
  void applyJ(ConstVec3Span in, Vec3Span out) const override { apply(in, out); }
  void addTransposed(ConstVec3Span out, Vec3Span in) const override {
    for (std::size_t i = 0; i < out.size(); ++i) in[2 * i] += out[i];
  }
};

inline Loaded tryBoundary(const std::string& xml) {
  SceneOptions options;
  options.pluginFolders.clear();
  Loaded loaded{std::make_unique<Scene>(options), false};
  Registry& registry = loaded.scene->registry();
  registerAll(registry);
  registry.add<WrittenMesh>("WrittenMesh");
  registry.add<EveryOther>("EveryOther");
  registry.add<PartialFixedProjectiveConstraint>("PartialFixedProjectiveConstraint");
  registry.add<FixedPlaneProjectiveConstraint>("FixedPlaneProjectiveConstraint");
  registry.add<SurfacePressureForceField>("SurfacePressureForceField");
  registry.add<TractionForceField>("TractionForceField");
  registry.add<GripForceField>("GripForceField");
  loaded.ready = loaded.scene->loadText(xml, "test.xml") && loaded.scene->initialise();
  return loaded;
}

inline Loaded loadBoundary(const std::string& xml) {
  Loaded loaded = tryBoundary(xml);
  EXPECT_TRUE(loaded.ready) << loaded.text();
  return loaded;
}

// An octahedron with outward normals; its first four triangles are the open upper half.
inline const std::string octahedronPoints = "1 0 0 0 1 0 -1 0 0 0 -1 0 0 0 1 0 0 -1";
inline const std::string octahedronTriangles = "0 1 4 1 2 4 2 3 4 3 0 4 1 0 5 2 1 5 3 2 5 0 3 5";

inline std::string onOctahedron(const std::string& content) {
  return dtNode(0.01, "<EulerExplicitSolver substeps='1'/><WrittenMesh position='" +
                          octahedronPoints + "' triangles='" + octahedronTriangles +
                          "'/><MechanicalObject/><UniformMass vertexMass='0.1'/>" + content);
}

}  // namespace stroma::test
