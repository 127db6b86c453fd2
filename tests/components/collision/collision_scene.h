// SPDX-License-Identifier: Apache-2.0
// Scenes in which scripted tools touch surfaces that are written out in the scene.
#pragma once

#include "components/collision/bvh_collision_model.h"
#include "components/collision/grip_contact.h"
#include "components/collision/penalty_contact.h"
#include "components/topology/mesh_topology.h"
#include "tests/components/collision/random_surface.h"
#include "tests/components/tools/tool_scene.h"
#include "tests/components/topology/hand_made_cut.h"

namespace stroma::test {

class WrittenMesh final : public Topology {
 public:
  Attribute<std::vector<Vec3>> position{this, "position", {}, "Points."};
  Attribute<std::vector<Triangle>> triangle{this, "triangles", {}, "Triangles."};
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return *triangle; }
};

// Each point lies between two particles, at 0.3 and 0.7.
class Between final : public Mapping {
 public:
  Link<MechanicalState> from{this, "input", "Particles.", Lookup::parent};
  Link<MechanicalState> to{this, "output", "Points.", Lookup::sameNode};
  [[nodiscard]] MechanicalState& input() const override { return *from; }
  [[nodiscard]] MechanicalState& output() const override { return *to; }
  void apply(ConstVec3Span in, Vec3Span out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = 0.3 * in[2 * i] + 0.7 * in[2 * i + 1];
  }
  void applyJ(ConstVec3Span in, Vec3Span out) const override { apply(in, out); }
  void addTransposed(ConstVec3Span out, Vec3Span in) const override {
    for (std::size_t i = 0; i < out.size(); ++i) {
      in[2 * i] += 0.3 * out[i];
      in[2 * i + 1] += 0.7 * out[i];
    }
  }
};

inline std::string text(const std::vector<Vec3>& points, int repeat = 1) {
  std::ostringstream out;
  out.precision(17);
  for (const Vec3& p : points) {
    for (int k = 0; k < repeat; ++k) out << p.transpose() << ' ';
  }
  return out.str();
}

inline std::string text(const std::vector<Triangle>& triangles) {
  std::ostringstream out;
  for (const Triangle& t : triangles) out << t[0] << ' ' << t[1] << ' ' << t[2] << ' ';
  return out.str();
}

inline std::string meshOf(const Surface& s) {
  return "<WrittenMesh name='mesh' position='" + text(s.x) + "' triangles='" + text(s.triangles) +
         "'/>";
}

// A surface whose nodes are held where they are.
inline std::string heldSurface(const Surface& s) {
  return "<EulerImplicitSolver/><CGLinearSolver/>" + meshOf(s) +
         "<MechanicalObject name='nodes'/><UniformMass vertexMass='1'/>"
         "<FixedProjectiveConstraint fixAll='true'/><BVHCollisionModel name='collision'/>";
}

// One whose nodes hang on springs (k, N/m).
inline std::string softSurface(const Surface& s, double k,
                               const std::string& solver = "newtonIterations='20'") {
  return "<EulerImplicitSolver rayleighMass='50' " + solver +
         "/><CGLinearSolver tolerance='1e-12' iterations='500'/>" + meshOf(s) +
         "<MechanicalObject name='nodes'/><UniformMass vertexMass='1e-4'/><StiffeningSprings k='" +
         std::to_string(k) + "'/><BVHCollisionModel name='collision'/>";
}

// Moves along the positions, one at each of the times (ms).
inline std::string hand(const std::string& times, const std::string& positions,
                        const std::string& more = "") {
  return "<ScriptedDevice name='hand' keyTimes='" + times + " ms' positions='" + positions + "' " +
         more + "/>";
}

inline Loaded tryCollision(const std::string& content) {
  SceneOptions options;
  options.pluginFolders.clear();
  options.writesOutput = false;
  Loaded loaded{std::make_unique<Scene>(options), false};
  Registry& registry = loaded.scene->registry();
  registerAll(registry);
  registerTools(registry);
  registry.add<WrittenMesh>("WrittenMesh");
  registry.add<Between>("Between");
  registry.add<MeshTopology>("MeshTopology");
  registry.add<Riding>("Riding");
  registry.add<BVHCollisionModel>("BVHCollisionModel");
  registry.add<PenaltyContactForceField>("PenaltyContactForceField");
  registry.add<GripContact>("GripContact");
  loaded.ready =
      loaded.scene->loadText(dtNode(0.001, content), "test.xml") && loaded.scene->initialise();
  return loaded;
}

inline Loaded loadCollision(const std::string& content) {
  Loaded loaded = tryCollision(content);
  EXPECT_TRUE(loaded.ready) << loaded.text();
  return loaded;
}

// Sum of what the force field puts on its state now.
inline Vec3 totalOn(ForceField& field, double time) {
  std::vector<Vec3> f(field.state().x().size(), Vec3::Zero());
  field.addForce(field.state().view(time), f);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& one : f) sum += one;
  return sum;
}

}  // namespace stroma::test
