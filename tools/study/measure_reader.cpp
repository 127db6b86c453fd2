// SPDX-License-Identifier: Apache-2.0
#include "tools/study/measure_reader.h"

#include <cmath>

#include "tools/study/element_reader.h"

namespace stroma::study {
namespace {

constexpr double mostPoints = 1e5;

// The kinds, in the order of Measure::Kind, and the attributes that have a meaning for each.
struct KindOfMeasure {
  std::string_view what;
  Names attributes;
};
const std::array<KindOfMeasure, 6> kinds{{
    {"what a monitor saw", {"monitor", "column", "scale"}},
    {"an attribute", {"attribute", "scale"}},
    {"a displacement field", {"state", "grid", "box", "points", "norm"}},
    {"an energy", {"of", "scale"}},
    {"a volume", {"of", "state", "topology", "scale"}},
    {"a reaction", {"of", "constraint", "component", "scale"}},
}};

// Which kind it is: one of four ways to say it; nothing where it is not said in just one.
std::optional<Measure::Kind> readKind(ElementReader& reader, const SceneElement& element) {
  constexpr std::array<std::string_view, 3> of{"energy", "volume", "reaction"};
  constexpr std::array<Measure::Kind, 3> kindsOf{Measure::Kind::energy, Measure::Kind::volume,
                                                 Measure::Kind::reaction};
  const bool hasOf = reader.find("of") != nullptr;
  const bool hasMonitor = reader.find("monitor") != nullptr;
  const bool hasAttribute = reader.find("attribute") != nullptr;
  const bool hasState = reader.find("state") != nullptr;
  const int ways = hasOf + hasMonitor + hasAttribute + (hasState && !hasOf);
  const std::size_t chosen = reader.choice("of", of);
  if (ways != 1) {
    reader.error(element.at, "measure-kind",
                 "says what is measured by one of 'monitor', 'attribute', 'state' (a displacement "
                 "field) and 'of'");
    return std::nullopt;
  }
  return hasOf          ? kindsOf[chosen]
         : hasMonitor   ? Measure::Kind::monitor
         : hasAttribute ? Measure::Kind::attribute
                        : Measure::Kind::field;
}

// Reports attributes that mean something for other kinds only.
void refuseMeaningless(ElementReader& reader, Measure::Kind kind) {
  const KindOfMeasure& own = kinds[static_cast<std::size_t>(kind)];
  std::string list;
  for (const std::string& name : own.attributes) list += (list.empty() ? "" : ", ") + name;
  Names refused;
  for (const KindOfMeasure& other : kinds) {
    for (const std::string& name : other.attributes) {
      const SceneAttribute* a = reader.find(name);
      const auto isAmong = [&](const Names& names) {
        return std::ranges::find(names, name) != names.end();
      };
      if (!a || isAmong(own.attributes) || isAmong(refused)) continue;
      refused.push_back(name);
      reader.error(a->nameAt, "attr-meaningless",
                   "'" + name + "' means nothing for " + std::string(own.what),
                   "besides name, reference, source and method it may have: " + list);
    }
  }
}

void readPaths(ElementReader& reader, const SceneElement& element, Measure& measure) {
  constexpr std::array<std::string_view, 4> components{"norm", "x", "y", "z"};
  const Measure::Kind kind = measure.kind;
  const char* pathName = kind == Measure::Kind::monitor     ? "monitor"
                         : kind == Measure::Kind::attribute ? "attribute"
                         : kind == Measure::Kind::reaction  ? "constraint"
                                                            : "state";
  measure.path = reader.text(pathName);
  measure.pathAt = reader.placeOf(pathName);
  measure.column = reader.text("column");
  measure.axis = reader.choice("component", components);
  measure.topology = reader.text("topology");
  measure.topologyAt = reader.placeOf("topology");
  if (kind == Measure::Kind::volume && (measure.path.empty() || measure.topology.empty())) {
    reader.error(element.at, "attr-required", "a volume needs 'state' and 'topology'");
  }
  if (kind == Measure::Kind::reaction && measure.path.empty()) {
    reader.error(element.at, "attr-required", "a reaction needs the 'constraint' that takes it");
  }
  for (const auto& [path, at] :
       {std::pair{measure.path, measure.pathAt}, std::pair{measure.topology, measure.topologyAt}}) {
    if (path.empty() || path.starts_with('/')) continue;
    reader.error(at, "path", "a path begins with '/', the root of the scene");
  }
}

std::vector<Vec3> gridPoints(const Box& box, const Vec3& n) {
  std::vector<Vec3> points;
  const auto at = [&](int axis, int i) {
    return n[axis] > 1 ? box.min[axis] + (box.max[axis] - box.min[axis]) * i / (n[axis] - 1)
                       : (box.min[axis] + box.max[axis]) / 2;
  };
  for (int k = 0; k < n.z(); ++k) {
    for (int j = 0; j < n.y(); ++j) {
      for (int i = 0; i < n.x(); ++i) points.emplace_back(at(0, i), at(1, j), at(2, k));
    }
  }
  return points;
}

// Where a field is compared: the points themselves, or those of a grid in a box.
void readPoints(ElementReader& reader, const SceneElement& element, Measure& measure) {
  constexpr std::array<std::string_view, 2> norms{"l2", "max"};
  const ValueContext metres{"m", UnitSystem{}};
  measure.norm = static_cast<Measure::Norm>(reader.choice("norm", norms));
  Vec3 n = Vec3::Zero();
  Box box;
  const bool hasGrid = reader.value("grid", {}, n), hasBox = reader.value("box", metres, box);
  const bool hasPoints = reader.value("points", metres, measure.points);
  measure.pointsAt = reader.placeOf(hasPoints ? "points" : "box");
  if (measure.kind != Measure::Kind::field) return;
  if (hasPoints == (hasGrid && hasBox)) {
    reader.error(element.at, "measure-points",
                 "a displacement field is compared at 'points', or at those of a 'grid' in a "
                 "'box'");
    return;
  }
  if (hasPoints && measure.points.empty()) {
    reader.error(measure.pointsAt, "measure-points", "'points' has none",
                 "three coordinates a point: points=\"0 0 0  0.1 0 0\"");
  }
  if (!hasGrid) return;
  if (n == n.array().round().matrix() && n.minCoeff() >= 1 && n.prod() <= mostPoints) {
    measure.points = gridPoints(box, n);
  } else {
    reader.error(reader.placeOf("grid"), "value-range",
                 "'grid' is three counts, of at most 100,000 points in all");
  }
}

// What a field is compared with where no run is named.
void readReferenceField(ElementReader& reader, Measure& measure) {
  if (!reader.value("reference", {"m", UnitSystem{}}, measure.referenceField)) return;
  const std::size_t wanted = measure.points.size(), given = measure.referenceField.size();
  if (wanted == given) return;
  reader.error(
      measure.referenceAt, "reference-kind",
      "has " + std::to_string(given) + " displacements for " + std::to_string(wanted) + " points",
      "a displacement field is compared with a run, reference=\"@name\", or with a "
      "displacement \"ux uy uz\" for each of its points");
}

void readReference(ElementReader& reader, const SceneElement& element, const Names& references,
                   Measure& measure) {
  measure.source = reader.text("source");
  Quantity value;
  if (reader.quantity("scale", value)) {
    measure.scaleAt = reader.placeOf("scale");
    value.value = std::abs(value.value);
    if (value.value > 0) measure.scale = value;
    if (value.value == 0) reader.error(measure.scaleAt, "value-range", "'scale' is not 0");
  }
  const std::string text = reader.text("reference");
  measure.referenceAt = reader.placeOf("reference");
  if (text.empty() || text == "none") return;
  if (text.starts_with('@')) {
    measure.referenceRun = text.substr(1);
    if (std::ranges::find(references, measure.referenceRun) == references.end()) {
      reader.error(measure.referenceAt, "reference-unknown",
                   "there is no ReferenceRun " + stroma::quoted(measure.referenceRun),
                   didYouMean(measure.referenceRun, references));
    }
    return;
  }
  if (measure.kind == Measure::Kind::field) {
    readReferenceField(reader, measure);
  } else if (reader.quantity("reference", value)) {
    measure.reference = value;
    if (value.value == 0 && !measure.scale) {
      reader.error(element.at, "reference-zero",
                   "what should be 0 needs a 'scale' that errors are relative to");
    }
  }
}

}  // namespace

Measure readMeasure(const SceneElement& element, const Names& methods, const Names& references,
                    Diagnostics& diagnostics) {
  Measure measure;
  ElementReader reader(element, diagnostics);
  measure.name = reader.required("name");
  measure.at = element.at;
  const auto kind = readKind(reader, element);
  measure.kind = kind.value_or(Measure::Kind::attribute);
  if (kind) refuseMeaningless(reader, *kind);
  readPaths(reader, element, measure);
  readPoints(reader, element, measure);
  readReference(reader, element, references, measure);
  measure.methods = reader.names("method");
  for (const std::string& method : measure.methods) {
    if (isAmong(method, methods) || isAmong(method, references)) continue;
    reader.error(reader.placeOf("method"), "method-unknown",
                 "there is no method " + stroma::quoted(method), didYouMean(method, methods));
  }
  for (const SceneElement& child : element.children) {
    reader.error(child.at, "element-unknown", "holds no elements");
  }
  return measure;
}

}  // namespace stroma::study
