// SPDX-License-Identifier: Apache-2.0
// What of a scene can be drawn: its triangle surfaces and its particles, with the fields on them.
// Everything here is called by the thread that makes the steps.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/interfaces/mesh.h"
#include "core/interfaces/stress_field.h"
#include "core/scene.h"
#include "plugins/viewer/frame.h"

namespace stroma::viewer {

// What the pages ask for, of all bodies.
struct Looks {
  std::set<int> particles;                      // bodies whose particles are to be sent
  std::map<int, std::set<std::string>> fields;  // by body
};

// A number at every point of a body: an output attribute of that size, or the von Mises stress of a
// force field that knows its stresses.
struct BodyField {
  std::string name, unit;
  const AttributeBase* output = nullptr;  // null: the stress
};

struct Body {
  int id = 0;
  MechanicalState* state = nullptr;
  Topology* topology = nullptr;  // null for particles
  std::vector<Triangle> hull;    // of elements, where the topology has no triangles
  int particles = -1;  // of a surface, the body that carries it; -1: none, itself: its own
  std::vector<BodyField> fields;
  StressField* stress = nullptr;  // of particles
  ForceField* links = nullptr;    // who knows the particles' neighbours
  std::vector<Index> nearest;     // of a surface's points, the particle whose fields they show
  std::optional<std::uint64_t> sentRevision;
  [[nodiscard]] std::uint64_t revision() const;
  [[nodiscard]] std::string path() const { return state->path(); }
};

class SceneBodies {
 public:
  SceneBodies(Scene& scene, std::uint64_t generation);

  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<Tool*>& tools() const { return tools_; }
  // Of all points at rest.
  [[nodiscard]] Eigen::AlignedBox3d bounds() const;
  // Of bodies that are new or have changed since the last call.
  [[nodiscard]] std::vector<std::shared_ptr<const TopologyCopy>> changedTopologies();
  // Fills the frame, whose storage is used again. Fields are worked out where `withFields`;
  // otherwise those of the last time are repeated.
  void copyInto(FrameCopy& frame, const Looks& looks, bool withFields);
  // Particles that the force on this one depends on.
  [[nodiscard]] std::vector<Index> neighboursOf(int body, Index particle) const;

 private:
  void findParticles();
  void findSurfaces();
  void findFields(Body& body);
  [[nodiscard]] const std::vector<float>& fieldOf(Body& body, const std::string& name, bool anew);
  [[nodiscard]] std::vector<float> evaluate(Body& body, const BodyField& field);
  void findNearest(Body& surface);

  Scene& scene_;
  std::uint64_t generation_;
  std::vector<Body> bodies_;
  std::vector<Tool*> tools_;
  std::map<std::pair<int, std::string>, std::vector<float>> fields_;  // of the last time
};

}  // namespace stroma::viewer
