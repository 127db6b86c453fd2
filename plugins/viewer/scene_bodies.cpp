// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/scene_bodies.h"

#include <algorithm>
#include <cmath>

#include "components/material/von_mises.h"
#include "components/mechanics/point_tree.h"
#include "core/parallel.h"
#include "core/traverse.h"

namespace stroma::viewer {
namespace {

using Numbers = Attribute<std::vector<double>>;
constexpr const char* stressName = "vonMises";

// Faces that only one element has, as triangles; a face with four corners becomes two.
class Hull {
 public:
  template <std::size_t N, std::size_t Corners>
  void add(const std::array<Index, N>& element,
           std::initializer_list<std::array<int, Corners>> faces) {
    for (const auto& face : faces) {
      std::array<Index, 4> corners{-1, -1, -1, -1};
      for (std::size_t i = 0; i < Corners; ++i) {
        corners[i] = element[static_cast<std::size_t>(face[i])];
      }
      std::array<Index, 4> key = corners;
      std::ranges::sort(key);
      const auto [at, isNew] = faces_.try_emplace(key, corners);
      if (!isNew) faces_.erase(at);
    }
  }
  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (const auto& [key, c] : faces_) {
      all.push_back({c[0], c[1], c[2]});
      if (c[3] >= 0) all.push_back({c[0], c[2], c[3]});
    }
    return all;
  }

 private:
  std::map<std::array<Index, 4>, std::array<Index, 4>> faces_;
};

// The surface to draw of a mesh without triangles of its own, outward oriented.
std::vector<Triangle> hullOf(const Topology& mesh) {
  Hull hull;
  for (const Tetrahedron& t : mesh.tetrahedra()) {
    hull.add(t, {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  }
  for (const Hexahedron& h : mesh.hexahedra()) {
    hull.add(h, {std::array{0, 3, 2, 1},
                 {4, 5, 6, 7},
                 {0, 1, 5, 4},
                 {1, 2, 6, 5},
                 {2, 3, 7, 6},
                 {3, 0, 4, 7}});
  }
  std::vector<Triangle> triangles = hull.triangles();
  for (const Quad& q : mesh.quads()) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

void copyPoints(ConstVec3Span from, std::vector<float>& to) {
  to.resize(3 * from.size());
  float* out = to.data();
  for (const Vec3& point : from) {
    for (int axis = 0; axis < 3; ++axis) *out++ = static_cast<float>(point[axis]);
  }
}

}  // namespace

std::uint64_t Body::revision() const { return topology ? topology->revision() : 0; }

SceneBodies::SceneBodies(Scene& scene, std::uint64_t generation)
    : scene_(scene), generation_(generation), tools_(collect<Tool>(scene.root())) {
  findParticles();
  findSurfaces();
  for (Body& body : bodies_) findFields(body);
}

void SceneBodies::findParticles() {
  for (const auto& system : scene_.systems()) {
    for (MechanicalState* state : system->states()) {
      Body body;
      body.id = static_cast<int>(bodies_.size());
      body.state = state;
      body.particles = body.id;
      for (ForceField* field : system->forceFields()) {
        if (&field->state() != state) continue;
        if (auto* stress = dynamic_cast<StressField*>(field)) body.stress = stress;
        if (!body.links && state->size() > 0 && !field->neighboursOf(0).empty()) body.links = field;
      }
      bodies_.push_back(std::move(body));
    }
  }
}

void SceneBodies::findSurfaces() {
  const std::vector<Mapping*> mappings = collect<Mapping>(scene_.root());
  const auto carrier = [&](const MechanicalState* state) {
    // each mapping leads one state nearer to the particles
    for (std::size_t i = 0; i <= mappings.size(); ++i) {
      const auto own = std::ranges::find_if(
          bodies_, [&](const Body& body) { return !body.topology && body.state == state; });
      if (own != bodies_.end()) return own->id;
      const auto up = std::ranges::find_if(
          mappings, [&](const Mapping* mapping) { return &mapping->output() == state; });
      if (up == mappings.end()) break;
      state = &(*up)->input();
    }
    return -1;
  };
  forEachNode(scene_.root(), [&](Node& node) {
    const auto states = collectHere<MechanicalState>(node);
    for (Topology* topology : collectHere<Topology>(node)) {
      const auto state = std::ranges::find_if(states, [&](const MechanicalState* s) {
        return static_cast<std::size_t>(s->size()) == topology->positions().size();
      });
      if (state == states.end()) continue;
      Body body;
      if (topology->triangles().empty()) {
        body.hull = hullOf(*topology);
        if (body.hull.empty()) continue;
      }
      body.id = static_cast<int>(bodies_.size());
      body.state = *state;
      body.topology = topology;
      body.particles = carrier(*state);
      bodies_.push_back(std::move(body));
      break;  // the node's own mesh
    }
  });
}

void SceneBodies::findFields(Body& body) {
  const auto size = static_cast<std::size_t>(body.state->size());
  for (const auto& component : body.state->node().components()) {
    for (const AttributeBase* attribute : component->attributes()) {
      const auto* numbers = dynamic_cast<const Numbers*>(attribute);
      if (!numbers || !numbers->info().output || numbers->value().size() != size) continue;
      body.fields.push_back(
          {std::string(numbers->name()), std::string(numbers->info().unit), numbers});
    }
  }
  const auto known = [&](const std::string& name) {
    return std::ranges::find(body.fields, name, &BodyField::name) != body.fields.end();
  };
  if (!body.topology) {
    if (body.stress && !known(stressName)) body.fields.push_back({stressName, "Pa", nullptr});
    return;
  }
  if (body.particles < 0) return;
  // a surface shows the fields of the particles below it, too
  for (const BodyField& field : bodies_[static_cast<std::size_t>(body.particles)].fields) {
    if (!known(field.name)) body.fields.push_back({field.name, field.unit, nullptr});
  }
}

Eigen::AlignedBox3d SceneBodies::bounds() const {
  Eigen::AlignedBox3d box;
  for (const Body& body : bodies_) {
    for (const Vec3& point : body.state->rest()) box.extend(point);
  }
  return box.isEmpty() ? Eigen::AlignedBox3d(Vec3::Zero()) : box;
}

std::vector<std::shared_ptr<const TopologyCopy>> SceneBodies::changedTopologies() {
  std::vector<std::shared_ptr<const TopologyCopy>> changed;
  for (Body& body : bodies_) {
    if (body.sentRevision == body.revision()) continue;
    body.sentRevision = body.revision();
    auto copy = std::make_shared<TopologyCopy>();
    copy->generation = generation_;
    copy->body = body.id;
    copy->revision = body.revision();
    copyPoints(body.state->rest(), copy->rest);
    if (body.topology) {
      const std::span<const Triangle> triangles =
          body.hull.empty() ? body.topology->triangles() : body.hull;
      for (const Triangle& triangle : triangles) {
        for (const Index node : triangle) {
          copy->triangles.push_back(static_cast<std::uint32_t>(node));
        }
      }
      const auto walls = body.topology->incisionWalls();
      copy->walls.assign(walls.begin(), walls.end());
      for (const Vec3& uv : body.topology->textureCoordinates()) {
        copy->texture.push_back(static_cast<float>(uv.x()));
        copy->texture.push_back(static_cast<float>(uv.y()));
      }
    }
    changed.push_back(std::move(copy));
  }
  return changed;
}

void SceneBodies::copyInto(FrameCopy& frame, const Looks& looks, bool withFields) {
  frame.generation = generation_;
  frame.step = scene_.stepCount();
  frame.time = scene_.time();
  std::size_t used = 0;
  for (Body& body : bodies_) {
    if (!body.topology && !looks.particles.contains(body.id)) continue;
    if (used == frame.bodies.size()) frame.bodies.emplace_back();
    BodyCopy& copy = frame.bodies[used++];
    copy.body = body.id;
    copy.revision = body.revision();
    copyPoints(body.state->x(), copy.positions);
    copy.fields.clear();
    const auto wanted = looks.fields.find(body.id);
    if (wanted == looks.fields.end()) continue;
    for (const std::string& name : wanted->second) {
      const std::vector<float>& values = fieldOf(body, name, withFields);
      if (!values.empty()) copy.fields.push_back({name, values});
    }
  }
  frame.bodies.resize(used);
  frame.tools.resize(tools_.size());
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const Tool& tool = *tools_[i];
    frame.tools[i] = {tool.path(),
                      tool.pose(),
                      tool.active(),
                      tool.totalForce(),
                      {tool.contacts().begin(), tool.contacts().end()}};
  }
}

const std::vector<float>& SceneBodies::fieldOf(Body& body, const std::string& name, bool anew) {
  std::vector<float>& kept = fields_[{body.id, name}];
  const auto points = static_cast<std::size_t>(body.state->size());
  if (!anew && kept.size() == points) return kept;
  const auto field = std::ranges::find(body.fields, name, &BodyField::name);
  if (field == body.fields.end()) return kept;
  if (field->output || !body.topology) {
    kept = evaluate(body, *field);
  } else {
    Body& particles = bodies_[static_cast<std::size_t>(body.particles)];
    const std::vector<float>& values = fieldOf(particles, name, anew);
    findNearest(body);
    kept.resize(points);
    for (std::size_t i = 0; i < points; ++i) {
      const auto particle = static_cast<std::size_t>(body.nearest[i]);
      kept[i] = particle < values.size() ? values[particle] : 0.0f;
    }
  }
  if (kept.size() != points) kept.clear();
  return kept;
}

std::vector<float> SceneBodies::evaluate(Body& body, const BodyField& field) {
  std::vector<float> values(static_cast<std::size_t>(body.state->size()));
  if (field.output) {
    const std::vector<double>& numbers = static_cast<const Numbers*>(field.output)->value();
    values.assign(numbers.begin(), numbers.end());
    return values;
  }
  const StateView at = body.state->view(scene_.time());
  parallelFor(body.state->size(), [&](Index i) {
    values[static_cast<std::size_t>(i)] =
        static_cast<float>(vonMisesStress(body.stress->stressAt(at, i)));
  });
  return values;
}

void SceneBodies::findNearest(Body& surface) {
  const ConstVec3Span points = surface.state->rest();
  const Body& particles = bodies_[static_cast<std::size_t>(surface.particles)];
  if (surface.nearest.size() > points.size()) surface.nearest.clear();  // whole again
  if (surface.nearest.size() == points.size() || particles.state->size() == 0) {
    surface.nearest.resize(points.size(), 0);
    return;
  }
  const PointTree tree(particles.state->rest());
  for (std::size_t i = surface.nearest.size(); i < points.size(); ++i) {
    Index nearest = 0;
    double squared = 0;
    tree.nearest(points[i], {&nearest, 1}, {&squared, 1});
    surface.nearest.push_back(nearest);
  }
}

std::vector<Index> SceneBodies::neighboursOf(int id, Index particle) const {
  if (id < 0 || static_cast<std::size_t>(id) >= bodies_.size()) return {};
  const Body& body = bodies_[static_cast<std::size_t>(id)];
  if (!body.links || particle < 0 || particle >= body.state->size()) return {};
  return body.links->neighboursOf(particle);
}

}  // namespace stroma::viewer
