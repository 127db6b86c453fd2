// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/scene_description.h"

#include <algorithm>

#include "core/plugin.h"
#include "core/traverse.h"

namespace stroma::viewer {
namespace {

using Json = nlohmann::json;

// Longer values (meshes, tables) are of no use in an inspector.
constexpr std::size_t longestValue = 200;
constexpr std::array<std::string_view, 3> swappableRoles = {"ForceField", "Integrator",
                                                            "LinearSolver"};

std::string_view roleOf(const Component& component) {
  Scene& scene = component.scene();
  const ModuleManifest* module = scene.modules().moduleOf(component.type());
  if (!module) return {};
  const auto role = module->roles.find(component.type());
  return role == module->roles.end() ? std::string_view() : role->second;
}

Json describe(const AttributeBase& a) {
  const AttributeInfo& info = a.info();
  std::string value = a.print();
  const bool isLong = value.size() > longestValue;
  if (isLong) value = value.substr(0, longestValue) + " ...";
  Json json{{"name", a.name()},         {"type", a.typeName()},      {"unit", info.unit},
            {"doc", a.doc()},           {"value", std::move(value)}, {"default", a.printDefault()},
            {"isSet", a.isSet()},       {"runtime", info.runtime},   {"output", info.output},
            {"required", info.required}};
  if (isLong) json["long"] = true;
  if (std::isfinite(info.min)) json["min"] = info.min;
  if (std::isfinite(info.max)) json["max"] = info.max;
  if (info.exclusiveMin) json["exclusiveMin"] = true;
  if (info.exclusiveMax) json["exclusiveMax"] = true;
  const auto choices = a.choices();
  if (!choices.empty()) json["choices"] = choices;
  return json;
}

Json attributesOf(const AttributeOwner& owner) {
  Json list = Json::array();
  for (const AttributeBase* attribute : owner.attributes()) list.push_back(describe(*attribute));
  return list;
}

Json describe(const Component& component) {
  const ComponentEntry* entry = component.scene().registry().find(component.type());
  const std::string_view role = roleOf(component);
  Json json{{"name", component.name()},
            {"path", component.path()},
            {"type", component.type()},
            {"role", role},
            {"doc", entry ? entry->doc : std::string()},
            {"attributes", attributesOf(component)},
            {"swappable", std::ranges::find(swappableRoles, role) != swappableRoles.end()}};
  if (const SourceRange& where = component.where()) {
    json["file"] = where.source->name();
    json["line"] = where.source->position(where.offset).line;
  }
  return json;
}

Json describe(const Node& node) {
  Json components = Json::array(), children = Json::array();
  for (const auto& component : node.components()) components.push_back(describe(*component));
  for (const auto& child : node.children()) children.push_back(describe(*child));
  return {{"name", node.name()},
          {"path", node.path()},
          {"attributes", attributesOf(node)},
          {"components", std::move(components)},
          {"children", std::move(children)}};
}

Json describe(const Body& body) {
  Json fields = Json::array();
  for (const BodyField& field : body.fields) {
    fields.push_back({{"name", field.name}, {"unit", field.unit}});
  }
  Json json{{"id", body.id},
            {"kind", body.topology ? "surface" : "particles"},
            {"path", body.path()},
            {"name", body.state->node().name()},
            {"fields", std::move(fields)}};
  if (body.topology && body.particles >= 0) json["particles"] = body.particles;
  return json;
}

Json points(std::span<const Vec3> list) {
  Json json = Json::array();
  for (const Vec3& p : list) json.push_back({p.x(), p.y(), p.z()});
  return json;
}

Json describe(Scene& scene, const Tool& tool) {
  const HapticDevice* device = deviceOf(scene, tool);
  return {{"path", tool.path()},
          {"type", tool.type()},
          {"device", device ? device->path() : std::string()},
          {"mouse", device && device->type() == "MouseDevice"},
          {"radius", tool.radius()},
          {"edge", points(tool.edge())},
          {"samples", points(tool.samplePoints())}};
}

}  // namespace

HapticDevice* deviceAmong(const Component& component) {
  for (const LinkBase* link : component.links()) {
    for (Component* target : link->components()) {
      if (auto* device = dynamic_cast<HapticDevice*>(target)) return device;
    }
  }
  return nullptr;
}

HapticDevice* deviceOf(Scene& scene, const Tool& tool) {
  if (HapticDevice* device = deviceAmong(tool)) return device;
  HapticDevice* found = nullptr;
  forEachComponent(scene.root(), [&](const Component& component) {
    for (const LinkBase* link : component.links()) {
      if (std::ranges::find(link->components(), &tool) == link->components().end()) continue;
      if (HapticDevice* device = deviceAmong(component)) found = device;
    }
  });
  return found;
}

std::vector<std::string> alternativesTo(const Component& component) {
  std::vector<std::string> types;
  const std::string_view role = roleOf(component);
  if (role.empty()) return types;
  for (const ModuleManifest& module : component.scene().modules().modules()) {
    for (const auto& [type, played] : module.roles) {
      if (played == role && type != component.type()) types.push_back(type);
    }
  }
  return types;
}

Json describeScene(Scene& scene, const SceneBodies& bodies, std::uint64_t generation,
                   const std::vector<std::string>& changes) {
  const Eigen::AlignedBox3d box = bodies.bounds();
  const Vec3 &low = box.min(), &high = box.max();
  Json list = Json::array(), tools = Json::array();
  for (const Body& body : bodies.bodies()) list.push_back(describe(body));
  for (const Tool* tool : bodies.tools()) tools.push_back(describe(scene, *tool));
  return {{"type", "scene"},
          {"generation", generation},
          {"file", scene.file().string()},
          {"dt", scene.dt()},
          {"duration", *scene.root().duration},
          {"bounds", {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}},
          {"root", describe(scene.root())},
          {"bodies", std::move(list)},
          {"tools", std::move(tools)},
          {"changes", changes}};
}

Json describe(const Diagnostics& diagnostics, bool broken) {
  const Json report = Json::parse(diagnostics.json());
  return {{"type", "diagnostics"}, {"items", report.at("diagnostics")}, {"broken", broken}};
}

}  // namespace stroma::viewer
