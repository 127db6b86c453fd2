// SPDX-License-Identifier: Apache-2.0
#include "tools/study/measures.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/projective_constraint.h"
#include "core/triangle.h"
#include "tools/study/field_fit.h"
#include "tools/study/scene_target.h"

namespace stroma::study {
namespace {

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

// Dead loads have an arbitrary constant in their energy: what counts is the difference to rest.
double energyOf(Scene& scene) {
  double energy = 0;
  for (const auto& system : scene.systems()) {
    energy -= system->potentialEnergy({system->rest(), system->v(), scene.time()});
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
  const double rest = enclosedVolume(state.rest(), mesh.triangles());
  if (rest == 0) problem = mesh.describe() + " encloses no volume";
  return rest != 0 ? enclosedVolume(state.x(), mesh.triangles()) / rest : 0;
}

// Distance of nodes from their nearest others, the mean over some of them.
double spacingOf(ConstVec3Span nodes) {
  constexpr std::size_t asked = 64;
  const std::size_t stride = std::max<std::size_t>(1, nodes.size() / asked);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < nodes.size() && nodes.size() > 1; i += stride) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) nearest2 = std::min(nearest2, (nodes[j] - nodes[i]).squaredNorm());
    }
    sum += std::sqrt(nearest2);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// A point beyond the nodes by more than a spacing: particles end half of one inside the body.
std::string outsider(ConstVec3Span nodes, ConstVec3Span points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& node : nodes) box.extend(node);
  const Vec3 margin = Vec3::Constant(spacingOf(nodes));
  const Eigen::AlignedBox3d allowed(box.min() - margin, box.max() + margin);
  for (const Vec3& point : points) {
    if (allowed.contains(point)) continue;
    const auto text = [](const Vec3& p) { return ValueTraits<Vec3>::print(p); };
    return "the point " + text(point) + " is outside the body, whose nodes lie between " +
           text(box.min()) + " and " + text(box.max()) + " (m)";
  }
  return "";
}

// What a constraint takes from the bodies it holds: minus the force along its held directions.
Vec3 reactionOf(Scene& scene, const ProjectiveConstraint& constraint) {
  std::vector<ParticleProjector> held;
  constraint.addProjectors(held);
  Vec3 sum = Vec3::Zero();
  for (const auto& system : scene.systems()) {
    const Index offset = system->offsetOf(constraint.state());
    if (offset < 0) continue;
    std::vector<Vec3> f(system->x().size());
    system->computeForce({system->x(), system->v(), scene.time()}, f);
    for (const ParticleProjector& p : held) {
      const Vec3& force = f[static_cast<std::size_t>(offset + p.particle)];
      sum -= force - p.projector * force;
    }
  }
  return sum;
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
  } else if (measure.kind == Measure::Kind::reaction) {
    if (const auto* c = componentAt<ProjectiveConstraint>(scene, measure.path, problem, hint)) {
      const Vec3 reaction = reactionOf(scene, *c);
      value = measure.axis == 0 ? reaction.norm()
                                : reaction[static_cast<Eigen::Index>(measure.axis) - 1];
    }
  } else {
    const auto* state = componentAt<MechanicalState>(scene, measure.path, problem, hint);
    if (state && measure.kind == Measure::Kind::field) {
      problem = outsider(state->rest(), measure.points);
      if (!problem.empty()) return {{"problem", problem}};
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
