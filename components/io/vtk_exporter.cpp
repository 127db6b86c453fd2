// SPDX-License-Identifier: Apache-2.0
#include "components/io/vtk_exporter.h"

#include <algorithm>
#include <cstdio>

#include "core/diagnostics.h"
#include "core/path.h"
#include "core/snapshot.h"

namespace stroma {
namespace {

std::string frameSuffix(std::uint64_t step) {
  char text[32];
  std::snprintf(text, sizeof text, "_%06llu", static_cast<unsigned long long>(step));
  return text;
}

std::vector<double> numbers(ConstVec3Span field) {
  const auto column = flat(field);
  return {column.begin(), column.end()};
}

// The attribute's values as a field of so many points; no components where they do not fit.
vtk::Field fieldOf(const AttributeBase& attribute, std::size_t points) {
  vtk::Field field{"", 0, {}};
  if (const auto* v = dynamic_cast<const Attribute<std::vector<double>>*>(&attribute)) {
    field.values = **v;
  } else if (const auto* whole = dynamic_cast<const Attribute<std::vector<int>>*>(&attribute)) {
    field.values.assign((*whole)->begin(), (*whole)->end());
  } else if (const auto* x = dynamic_cast<const Attribute<std::vector<Vec3>>*>(&attribute)) {
    field.values = numbers(**x);
    if ((*x)->size() == points) field.components = 3;
    return field;
  }
  if (!field.values.empty() && field.values.size() == points) field.components = 1;
  return field;
}

template <class Span>
Span shown(bool show, Span elements) {
  return show ? elements : Span{};
}

}  // namespace

void VtkExporter::bind() {
  for (const std::string& name : *fields) {
    const auto& names = EnumNames<PointField>::names;
    const auto found =
        std::ranges::find(names, name, &std::pair<PointField, std::string_view>::second);
    if (found == names.end()) {
      error(fields, "field-unknown", "has no field " + stroma::quoted(name),
            "fields: displacement, position, velocity, force; attributes of components go into "
            "'pointsDataFields'");
    } else {
      stateFields_.push_back(found->first);
    }
  }
  if (const AttributeBase* linked = pointsDataFields.source()) {
    sources_.push_back({std::string(linked->name()), linked});
  } else {
    for (const std::string& text : *pointsDataFields) addSource(text);
  }
  elements_ = mesh ? mesh.get() : topology.get();
  if (elements_) checkElements();
}

void VtkExporter::addSource(const std::string& text) {
  const std::size_t equals = text.find('=');
  std::string path = equals == std::string::npos ? text : text.substr(equals + 1);
  if (path.starts_with('@')) path.erase(0, 1);
  const PathParts parts = splitPath(path);
  std::string problem, hint;
  const PathTarget target = resolvePath(node(), this, parts.object, problem, hint);
  if (parts.attribute.empty() || !target.component) {
    if (problem.empty()) problem = "expected component.attribute";
    return error(pointsDataFields, "field-unknown",
                 "names " + stroma::quoted(text) + ": " + problem, hint);
  }
  const AttributeBase* attribute = target.component->attribute(parts.attribute);
  if (!attribute) {
    const auto names = target.component->attributeAndLinkNames();
    return error(pointsDataFields, "field-unknown",
                 "names " + stroma::quoted(text) + ": " + target.component->describe() +
                     " has no such attribute",
                 didYouMean(parts.attribute, names));
  }
  const std::string name =
      equals == std::string::npos ? std::string(parts.attribute) : text.substr(0, equals);
  sources_.push_back({name, attribute});
}

void VtkExporter::checkElements() {
  Index last = -1;
  const auto look = [&](const auto& elements) {
    for (const auto& element : elements) last = std::max(last, std::ranges::max(element));
  };
  look(elements_->edges());
  look(elements_->triangles());
  look(elements_->quads());
  look(elements_->tetrahedra());
  look(elements_->hexahedra());
  if (last >= mechanicalState->size()) {
    error("export-elements",
          "writes elements of " + elements_->describe() + " that use point " +
              std::to_string(last) + "; the state has " + std::to_string(mechanicalState->size()),
          "link the state that belongs to them with state=\"@...\"");
  }
}

void VtkExporter::start() {
  const auto points = static_cast<std::size_t>(mechanicalState->size());
  for (const Source& source : sources_) {
    if (fieldOf(*source.attribute, points).components > 0) continue;
    error(pointsDataFields, "field-size",
          "names '" + source.attribute->owner().path() + "." +
              std::string(source.attribute->name()) + "' (" + source.attribute->typeName() +
              "), which has not one number or vector for each of " + std::to_string(points) +
              " points");
  }
  vtk::Picture first{};
  addElements(first);
  surface_ = vtk::isSurface(first);
}

void VtkExporter::topologyChanged(const TopologyChange& change) {
  checkFollows(change, *mechanicalState, elements_);
}

void VtkExporter::addStateField(PointField field, vtk::Picture& picture) const {
  const MechanicalState& state = *mechanicalState;
  vtk::Field values{ValueTraits<PointField>::print(field), 3, {}};
  switch (field) {
    case PointField::position:
      values.values = numbers(state.x());
      break;
    case PointField::velocity:
      values.values = numbers(state.v());
      break;
    case PointField::force:
      values.values = numbers(state.f());
      break;
    case PointField::displacement: {
      values.values = numbers(state.x());
      const auto rest = flat(state.rest());
      for (std::size_t i = 0; i < values.values.size(); ++i) {
        values.values[i] -= rest[static_cast<Eigen::Index>(i)];
      }
      break;
    }
  }
  picture.fields.push_back(std::move(values));
}

void VtkExporter::addAttributeField(Source& source, vtk::Picture& picture) {
  vtk::Field field = fieldOf(*source.attribute, picture.points.size());
  field.name = source.name;
  if (field.components > 0) {
    picture.fields.push_back(std::move(field));
  } else if (!source.missed) {
    source.missed = true;
    warning("field-size", "leaves out '" + source.name + "', which has not a value for each of " +
                              std::to_string(picture.points.size()) + " points");
  }
}

void VtkExporter::addElements(vtk::Picture& picture) const {
  if (!elements_) return;
  picture.edges = shown(showEdges, elements_->edges());
  picture.triangles = shown(showTriangles, elements_->triangles());
  picture.quads = shown(showTriangles, elements_->quads());
  picture.tetrahedra = shown(showTetrahedra, elements_->tetrahedra());
  picture.hexahedra = shown(showHexahedra, elements_->hexahedra());
  // a surface may be listed twice, as quads and as the triangles that they are split into
  if (!picture.triangles.empty()) picture.quads = {};
  if (!picture.tetrahedra.empty() || !picture.hexahedra.empty()) {
    picture.triangles = {}, picture.quads = {};
  }
}

vtk::Picture VtkExporter::picture(double time) {
  vtk::Picture picture{};
  picture.points = mechanicalState->x();
  picture.time = time;
  addElements(picture);
  for (const PointField field : stateFields_) addStateField(field, picture);
  for (Source& source : sources_) addAttributeField(source, picture);
  return picture;
}

void VtkExporter::record(double time, std::uint64_t step) {
  const vtk::Picture now = picture(time);
  const char* extension = surface_ ? ".vtp" : ".vtu";
  replaceFile(outputFile(frameSuffix(step) + extension),
              surface_ ? vtk::polyData(now) : vtk::unstructuredGrid(now));
  if (!writes()) return;
  times_.push_back(time);
  steps_.push_back(step);
  std::vector<vtk::Frame> frames;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const auto file = outputFile(frameSuffix(steps_[i]) + extension);
    frames.push_back({times_[i], file.filename().string()});
  }
  replaceFile(outputFile(".pvd"), vtk::collection(frames));
}

void VtkExporter::reset() {
  Recorder::reset();
  times_.clear();
  steps_.clear();
}

void VtkExporter::save(StateWriter& writer) const {
  writer.write("times", std::span<const double>(times_));
  writer.write("steps", std::span<const std::uint64_t>(steps_));
}

void VtkExporter::restore(StateReader& reader) {
  times_.resize(reader.count<double>("times"));
  steps_.resize(reader.count<std::uint64_t>("steps"));
  if (times_.size() != steps_.size() || !reader.read("times", std::span(times_)) ||
      !reader.read("steps", std::span(steps_))) {
    times_.clear();
    steps_.clear();
  }
  setLastStep(steps_.empty() ? std::nullopt : std::optional(steps_.back()));
}

}  // namespace stroma
