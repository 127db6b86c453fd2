// SPDX-License-Identifier: Apache-2.0
#include "tools/study/measure_reader.h"

#include <cmath>

#include "tools/study/element_reader.h"

namespace stroma::study {
namespace {

constexpr double mostPoints = 1e5;

// What is measured: one of four ways to say it.
void readKind(ElementReader& reader, const SceneElement& element, Measure& measure) {
  constexpr std::array<std::string_view, 2> of{"energy", "volume"};
  const bool hasOf = reader.find("of") != nullptr;
  const bool isVolume = reader.choice("of", of) == 1;
  const bool hasMonitor = reader.find("monitor") != nullptr;
  const bool hasAttribute = reader.find("attribute") != nullptr;
  const bool hasState = reader.find("state") != nullptr;
  const int ways = hasOf + hasMonitor + hasAttribute + (hasState && !hasOf);
  if (ways != 1) {
    reader.error(element.at, "measure-kind",
                 "says what is measured by one of 'monitor', 'attribute', 'state' (a displacement "
                 "field) and 'of'");
  }
  measure.kind = hasOf          ? (isVolume ? Measure::Kind::volume : Measure::Kind::energy)
                 : hasMonitor   ? Measure::Kind::monitor
                 : hasAttribute ? Measure::Kind::attribute
                                : Measure::Kind::field;
  const char* pathName = hasMonitor ? "monitor" : hasAttribute ? "attribute" : "state";
  measure.path = reader.text(pathName);
  measure.pathAt = reader.placeOf(pathName);
  measure.column = reader.text("column");
  measure.topology = reader.text("topology");
  measure.topologyAt = reader.placeOf("topology");
  if (isVolume && (measure.path.empty() || measure.topology.empty())) {
    reader.error(element.at, "attr-required", "a volume needs 'state' and 'topology'");
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
  const bool given = reader.find("points") || reader.find("grid") || reader.find("box");
  measure.norm = static_cast<Measure::Norm>(reader.choice("norm", norms));
  Vec3 n = Vec3::Zero();
  Box box;
  const bool hasGrid = reader.value("grid", {}, n), hasBox = reader.value("box", metres, box);
  const bool hasPoints = reader.value("points", metres, measure.points);
  if (measure.kind != Measure::Kind::field) {
    if (given) reader.error(element.at, "measure-points", "only a displacement field has points");
    return;
  }
  if (hasPoints == (hasGrid && hasBox)) {
    reader.error(element.at, "measure-points",
                 "a displacement field is compared at 'points', or at those of a 'grid' in a "
                 "'box'");
    return;
  }
  if (!hasGrid) return;
  if (n == n.array().round().matrix() && n.minCoeff() >= 1 && n.prod() <= mostPoints) {
    measure.points = gridPoints(box, n);
  } else {
    reader.error(reader.placeOf("grid"), "value-range",
                 "'grid' is three counts, of at most 100,000 points in all");
  }
}

void readReference(ElementReader& reader, const SceneElement& element, const Names& references,
                   Measure& measure) {
  measure.source = reader.text("source");
  Quantity scale;
  if (reader.quantity("scale", scale)) measure.scale = std::abs(scale.value);
  const std::string text = reader.text("reference");
  if (text.empty() || text == "none") return;
  if (text.starts_with('@')) {
    measure.referenceRun = text.substr(1);
    if (std::ranges::find(references, measure.referenceRun) == references.end()) {
      reader.error(reader.placeOf("reference"), "reference-unknown",
                   "there is no ReferenceRun " + stroma::quoted(measure.referenceRun),
                   didYouMean(measure.referenceRun, references));
    }
    return;
  }
  Quantity value;
  if (measure.kind == Measure::Kind::field) {
    reader.error(reader.placeOf("reference"), "reference-kind",
                 "a displacement field is compared with a run: reference=\"@name\"");
  } else if (reader.quantity("reference", value)) {
    measure.reference = value.value;
    if (value.value == 0 && measure.scale == 0) {
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
  readKind(reader, element, measure);
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
