// SPDX-License-Identifier: Apache-2.0
#include "tools/study/measures.h"

#include <cmath>

#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/path.h"
#include "core/triangle.h"
#include "tools/study/field_fit.h"

namespace stroma::study {
namespace {

// What a path names: a component, or a numeric attribute of one or of a node.
struct Target {
  Component* component = nullptr;
  AttributeBase* attribute = nullptr;
};

Target targetOf(Scene& scene, const std::string& path, bool isAttribute, std::string& problem,
                std::string& hint) {
  const PathParts parts = isAttribute ? splitPath(path) : PathParts{path, {}};
  const PathTarget found = resolvePath(scene.root(), nullptr, parts.object, problem, hint);
  if (!found) return {};
  if (!isAttribute) {
    if (!found.component) problem = stroma::quoted(path) + " is a node; a component is wanted";
    return {found.component, nullptr};
  }
  AttributeOwner& owner =
      found.component ? static_cast<AttributeOwner&>(*found.component) : *found.node;
  AttributeBase* attribute = owner.attribute(parts.attribute);
  if (!attribute) {
    problem = owner.describe() + " has no attribute " + stroma::quoted(parts.attribute);
    std::vector<std::string> names;
    for (const AttributeBase* a : owner.attributes()) names.emplace_back(a->name());
    hint = didYouMean(parts.attribute, names);
  } else if (!attribute->number()) {
    problem = stroma::quoted(path) + " is not a number but " + attribute->typeName();
    attribute = nullptr;
  }
  return {found.component, attribute};
}

template <class T>
T* componentAt(Scene& scene, const std::string& path, std::string& problem, std::string& hint) {
  Component* component = targetOf(scene, path, false, problem, hint).component;
  T* wanted = dynamic_cast<T*>(component);
  if (component && !wanted) {
    problem = stroma::quoted(path) + " is a " + component->type() + "; a " + std::string(T::role) +
              " is wanted";
  }
  return wanted;
}

// Six times the volume inside the triangles.
double sixfoldVolume(std::span<const Triangle> triangles, ConstVec3Span x) {
  double volume = 0;
  for (const Triangle& t : triangles) {
    const Corners c = cornersOf(t, x);
    volume += c.a.dot(c.b.cross(c.c));
  }
  return volume;
}

double valueOfMonitor(Observer& monitor, const std::string& column, std::string& problem) {
  const auto values = monitor.lastValues();
  std::string names;
  for (const auto& [name, value] : values) {
    if (values.size() == 1 && column.empty()) return value;
    if (name == column) return value;
    names += (names.empty() ? "" : ", ") + name;
  }
  problem = values.empty()
                ? monitor.describe() + " has seen no value"
                : monitor.describe() + " has several values: say column=\"...\", one of " + names;
  return 0;
}

double energyOf(Scene& scene) {
  double energy = 0;
  for (const auto& system : scene.systems()) {
    energy += system->potentialEnergy({system->x(), system->v(), scene.time()});
  }
  return energy;
}

double volumeRatio(const MechanicalState& state, const Mesh& mesh, std::string& problem) {
  for (const Triangle& t : mesh.triangles()) {
    for (const Index corner : t) {
      if (corner >= 0 && corner < state.size()) continue;
      problem = mesh.describe() + " has triangles of nodes that " + state.describe() + " lacks";
      return 0;
    }
  }
  const double rest = sixfoldVolume(mesh.triangles(), state.rest());
  if (rest == 0) problem = mesh.describe() + " encloses no volume";
  return rest != 0 ? sixfoldVolume(mesh.triangles(), state.x()) / rest : 0;
}

Json fieldOf(const MechanicalState& state, ConstVec3Span points) {
  std::vector<Vec3> u(state.x().begin(), state.x().end());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= state.rest()[i];
  Json field = Json::array();
  for (const Vec3& value : fitField(state.rest(), u, points)) {
    for (const double part : value) field.push_back(part);
  }
  return field;
}

}  // namespace

void checkMeasure(Scene& scene, const Measure& measure, Diagnostics& diagnostics) {
  std::string problem, hint;
  const auto report = [&](const SourceRange& at) {
    if (problem.empty()) return;
    diagnostics.error("measure", "Measure " + stroma::quoted(measure.name) + ": " + problem, at,
                      hint);
    problem.clear();
    hint.clear();
  };
  switch (measure.kind) {
    case Measure::Kind::monitor:
      (void)componentAt<Observer>(scene, measure.path, problem, hint);
      break;
    case Measure::Kind::attribute:
      (void)targetOf(scene, measure.path, true, problem, hint);
      break;
    case Measure::Kind::volume:
      (void)componentAt<Mesh>(scene, measure.topology, problem, hint);
      report(measure.topologyAt);
      [[fallthrough]];
    case Measure::Kind::field:
      (void)componentAt<MechanicalState>(scene, measure.path, problem, hint);
      break;
    case Measure::Kind::energy:
      break;
  }
  report(measure.pathAt);
}

Json evaluate(Scene& scene, const Measure& measure) {
  std::string problem, hint;
  double value = 0;
  if (measure.kind == Measure::Kind::monitor) {
    if (auto* monitor = componentAt<Observer>(scene, measure.path, problem, hint)) {
      value = valueOfMonitor(*monitor, measure.column, problem);
    }
  } else if (measure.kind == Measure::Kind::attribute) {
    const Target target = targetOf(scene, measure.path, true, problem, hint);
    if (target.attribute) value = *target.attribute->number();
  } else if (measure.kind == Measure::Kind::energy) {
    value = energyOf(scene);
  } else {
    const auto* state = componentAt<MechanicalState>(scene, measure.path, problem, hint);
    if (state && measure.kind == Measure::Kind::field) {
      return {{"field", fieldOf(*state, measure.points)}};
    }
    const Mesh* mesh = state ? componentAt<Mesh>(scene, measure.topology, problem, hint) : nullptr;
    if (mesh) value = volumeRatio(*state, *mesh, problem);
  }
  if (!problem.empty()) return {{"problem", problem}};
  if (!std::isfinite(value)) return {{"problem", "is not finite"}};
  return {{"value", value}};
}

}  // namespace stroma::study
