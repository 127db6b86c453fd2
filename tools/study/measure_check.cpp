// SPDX-License-Identifier: Apache-2.0
#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/projective_constraint.h"
#include "core/traverse.h"
#include "tools/study/measures.h"
#include "tools/study/scene_target.h"

namespace stroma::study {
namespace {

// XPBD's constraints are no force fields: neither their energy nor their forces are known here.
std::string whyNoForces(Scene& scene) {
  std::string found;
  forEachComponent(scene.root(), [&](Component& component) {
    const std::string type = component.type();
    if (type.starts_with("XPBD") && type.ends_with("Constraint")) found = component.describe();
  });
  return found.empty() ? "" : found + " has neither energies nor forces that can be measured";
}

// What a measured value is in, where that is known.
std::optional<Dimension> dimensionOf(Scene& scene, const Measure& measure) {
  const auto of = [](std::string_view unit) {
    return unit.empty() ? Dimension{} : parseUnit(unit).value_or(Unit{}).dimension;
  };
  std::string problem, hint;
  switch (measure.kind) {
    case Measure::Kind::energy:
      return of("J");
    case Measure::Kind::reaction:
      return of("N");
    case Measure::Kind::volume:
      return Dimension{};
    case Measure::Kind::field:
      return of("m");
    case Measure::Kind::attribute:
      if (const Target target = targetOf(scene, measure.path, true, problem, hint);
          target.attribute) {
        return of(target.attribute->info().unit);
      }
      return std::nullopt;
    case Measure::Kind::monitor:
      break;
  }
  // what a Monitor records, by its own words; of other observers nothing is known
  auto* monitor = componentAt<Observer>(scene, measure.path, problem, hint);
  const AttributeBase* quantity = monitor ? monitor->attribute("quantity") : nullptr;
  const AttributeBase* other = monitor ? monitor->attribute("attribute") : nullptr;
  if (!quantity || (other && other->isSet())) return std::nullopt;
  const std::string word = quantity->print();
  if (word == "displacement" || word == "position") return of("m");
  if (word == "velocity") return of("m/s");
  if (word == "force" || word == "reaction") return of("N");
  if (word.ends_with("Energy")) return of("J");
  return std::nullopt;
}

// Numbers without a unit are SI, whatever is measured.
void checkUnits(Scene& scene, const Measure& measure, Diagnostics& diagnostics) {
  const auto wanted = dimensionOf(scene, measure);
  if (!wanted) return;
  for (const auto& [what, given, at] :
       {std::tuple{"reference", measure.reference, measure.referenceAt},
        std::tuple{"scale", measure.scale, measure.scaleAt}}) {
    if (!given || given->dimension == Dimension{} || given->dimension == *wanted) continue;
    diagnostics.error("unit-dimension",
                      "Measure " + stroma::quoted(measure.name) + ": '" + what + "': expected " +
                          (*wanted == Dimension{} ? "a pure number" : dimensionName(*wanted)) +
                          ", got " + dimensionName(given->dimension),
                      at);
  }
}

}  // namespace

void checkMeasure(Scene& scene, const Measure& measure, Diagnostics& diagnostics) {
  checkUnits(scene, measure, diagnostics);
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
    case Measure::Kind::reaction:
      (void)componentAt<ProjectiveConstraint>(scene, measure.path, problem, hint);
      report(measure.pathAt);
      [[fallthrough]];
    case Measure::Kind::energy:
      problem = whyNoForces(scene);
      if (!problem.empty()) hint = "limit the measure to other methods: method=\"...\"";
      return report(measure.at);
  }
  report(measure.pathAt);
}

}  // namespace stroma::study
