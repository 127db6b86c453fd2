// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/equipment.h"

#include <tinyxml2.h>

#include <algorithm>
#include <stdexcept>

#include "core/interfaces/collision_model.h"
#include "core/traverse.h"

namespace stroma::viewer {
namespace {

// Of a surface: how large a tool for it is, and how stiff a contact with it.
struct Measure {
  double size;          // m, diagonal of its bounds
  double reach;         // m, of a tool's end
  double youngModulus;  // Pa, of what carries it; 0 where that is not known
  double nodesInReach;  // on average
};

std::string text(double number) { return ValueTraits<double>::print(number); }
std::string text(const Vec3& v) { return ValueTraits<Vec3>::print(v); }

double youngModulusOf(Scene& scene, const Body& surface) {
  double found = 0;
  forEachComponent(scene.root(), [&](const Component& component) {
    const auto* field = dynamic_cast<const ForceField*>(&component);
    const AttributeBase* modulus = component.attribute("youngModulus");
    if (!field || !modulus || !modulus->number()) return;
    const bool below = component.path().starts_with(surface.state->node().path());
    const bool above = surface.path().starts_with(component.node().path());
    if (below || above) found = *modulus->number();
  });
  return found;
}

Measure measure(Scene& scene, const Body& surface) {
  const ConstVec3Span points = surface.state->rest();
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  Measure m{box.diagonal().norm(), 0, youngModulusOf(scene, surface), 1};
  m.reach = 0.04 * m.size;
  // around some of the nodes
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 20);
  std::size_t asked = 0, counted = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++asked) {
    counted += static_cast<std::size_t>(std::ranges::count_if(
        points, [&](const Vec3& p) { return (p - points[i]).norm() < m.reach; }));
  }
  m.nodesInReach = static_cast<double>(counted) / static_cast<double>(asked);
  return m;
}

// Somewhere beside the body.
Pose parkedAt(const Body& surface, double size) {
  Pose pose;
  for (const Vec3& p : surface.state->rest()) {
    pose.position += p / static_cast<double>(surface.state->size());
  }
  pose.position.z() += size;
  return pose;
}

// Stiffness of a tissue of this modulus against something of this size (both of the order of the
// flat punch's 2 E a): what holds it should be some times stiffer.
double holdingStiffness(const Measure& m) {
  constexpr double unknown = 100;  // N/m
  return m.youngModulus > 0 ? 4 * m.youngModulus * m.reach : unknown;
}

}  // namespace

std::string mouseElement(const std::string& name, const Pose& pose) {
  const auto& q = pose.orientation;
  return "<MouseDevice name=\"" + name + "\" position=\"" + text(pose.position) +
         " m\" orientation=\"" + text(q.x()) + " " + text(q.y()) + " " + text(q.z()) + " " +
         text(q.w()) + "\"/>";
}

std::string pullElements(Scene& scene, const Body& surface) {
  const Measure m = measure(scene, surface);
  return mouseElement("pull_hand", parkedAt(surface, m.size)) +
         "<GripTool name=\"pull\" device=\"@pull_hand\" radius=\"" + text(m.reach) +
         " m\"/><GripContact name=\"pull_grip\" tool=\"@pull\" state=\"@" + surface.state->name() +
         "\" stiffness=\"" + text(holdingStiffness(m) / m.nodesInReach) + " N/m\"/>";
}

std::string probeElements(Scene& scene, const Body& surface) {
  const Measure m = measure(scene, surface);
  std::string elements = mouseElement("probe_hand", parkedAt(surface, m.size)) +
                         "<ProbeTool name=\"probe\" device=\"@probe_hand\" radius=\"" +
                         text(m.reach) + " m\"/>";
  const auto models = collect<CollisionModel>(scene.root());
  const auto own = std::ranges::find_if(
      models, [&](const CollisionModel* model) { return &model->state() == surface.state; });
  std::string model = "probe_collision";
  if (own != models.end()) {
    model = (*own)->path();
  } else {
    elements += "<BVHCollisionModel name=\"" + model + "\" state=\"@" + surface.state->name() +
                "\" topology=\"@" + surface.topology->name() + "\"/>";
  }
  return elements + "<PenaltyContactForceField name=\"probe_contact\" collision=\"@" + model +
         "\" tools=\"@probe\" stiffness=\"" + text(holdingStiffness(m)) + " N/m\"/>";
}

std::string withScriptedDevices(const std::string& sceneText,
                                const std::vector<std::string>& tables) {
  tinyxml2::XMLDocument document;
  if (document.Parse(sceneText.c_str(), sceneText.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("the scene's own text cannot be read");
  }
  std::size_t next = 0;
  const auto visit = [&](tinyxml2::XMLElement* element, const auto& self) -> void {
    if (std::string_view(element->Name()) == "MouseDevice" && next < tables.size()) {
      const char* given = element->Attribute("name");
      const std::string name = given ? given : "";
      while (element->FirstAttribute()) element->DeleteAttribute(element->FirstAttribute()->Name());
      element->SetName("ScriptedDevice");
      if (!name.empty()) element->SetAttribute("name", name.c_str());
      element->SetAttribute("filename", tables[next++].c_str());
    }
    for (auto* child = element->FirstChildElement(); child; child = child->NextSiblingElement()) {
      self(child, self);
    }
  };
  if (document.RootElement()) visit(document.RootElement(), visit);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace stroma::viewer
