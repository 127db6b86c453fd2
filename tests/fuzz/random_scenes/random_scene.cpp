// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/random_scene.h"

#include <algorithm>

#include "core/interfaces/animation_loop.h"
#include "core/interfaces/collision_model.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/haptic_device.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/linear_solver.h"
#include "core/interfaces/mapping.h"
#include "core/interfaces/mass.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/projective_constraint.h"
#include "core/interfaces/tool.h"
#include "core/interfaces/topology_modifier.h"
#include "tests/fuzz/random_scenes/random_body.h"
#include "tests/fuzz/random_scenes/random_value.h"

namespace stroma::fuzz {
namespace {

using Given = std::vector<std::pair<std::string, std::string>>;

class SceneMaker {
 public:
  SceneMaker(const Catalogue& catalogue, std::uint64_t seed)
      : catalogue_(catalogue), dice_(seed), manner_(randomManner()), value_(dice_, manner_) {}

  RandomScene make(const TrialFolders& folders, const Mending::LookAt& before);

 private:
  struct Placed {
    const Kind* kind;
    std::string path;
  };

  Manner randomManner() {
    const double share = dice_.uniform(0, 1);
    if (share < 0.6) return Manner::sensible;
    return share < 0.8 ? Manner::extreme : Manner::broken;
  }
  template <class Role>
  [[nodiscard]] const Kind* any() {
    const auto kinds = catalogue_.playing<Role>();
    return kinds.empty() ? nullptr : dice_.oneOf(kinds);
  }

  // For bodies that are cut one whose elasticities are force fields: constraints do not follow
  // cuts.
  [[nodiscard]] const Kind* anyIntegrator() {
    const Kind* kind = any<Integrator>();
    while (wantsCuts_ && !dynamic_cast<const ForceField*>(
                             catalogue_.elasticities(*kind).front()->prototype.get())) {
      kind = any<Integrator>();
    }
    return kind;
  }

  // An element of the kind with random attributes, and links to what has been placed before.
  Element element(const Kind& kind, const std::string& name, const std::string& node,
                  const Given& given = {}, double share = 0.1);
  void setLink(Element& element, LinkBase& link);
  [[nodiscard]] double shareOf(const AttributeBase& attribute, double share) const;
  void place(const Element& element, const std::string& node);

  void addTools(Element& root);
  [[nodiscard]] Element device(const std::string& name);
  [[nodiscard]] Element bodyNode();
  void addMass(Element& body);
  void addElasticity(Element& body);
  void addSupports(Element& body);
  void addSurface(Element& body);
  void addContactAndCuts(Element& body);
  void addExtras(Element& body);
  void addActions();

  const Catalogue& catalogue_;
  Dice dice_;
  Manner manner_;
  RandomValue value_;
  Proportions proportions_;
  RandomBody body_;
  RandomScene scene_;
  std::vector<Placed> placed_;
  bool hasSurface_ = false, wantsCuts_ = false;
};

double SceneMaker::shareOf(const AttributeBase& attribute, double share) const {
  const AttributeInfo& info = attribute.info();
  if (info.required) return manner_ == Manner::broken ? 0.97 : 1;
  if (manner_ != Manner::sensible) share *= 1.5;
  const std::string type = attribute.typeName();
  const bool isMaterial = info.unit == "Pa" || (std::isfinite(info.min) && std::isfinite(info.max));
  if (isMaterial && type == "number") return std::max(share, 0.6);
  if (!attribute.choices().empty()) return std::max(share, 0.25);
  // lists and texts mostly have to agree with something else
  const bool isSimple = type == "number" || type == "whole number" || type == "true or false";
  return isSimple ? share : 0.15 * share;
}

Element SceneMaker::element(const Kind& kind, const std::string& name, const std::string& node,
                            const Given& given, double share) {
  Element e{kind.name, {{"name", name}}, {}};
  for (const auto& [key, value] : given) {
    if (key == "src" || kind.prototype->attribute(key) || kind.prototype->link(key)) {
      e.set(key, value);
    }
  }
  proportions_.entries = dice_.whole(1, 4);
  for (const AttributeBase* attribute : kind.prototype->attributes()) {
    const std::string key(attribute->name());
    if (attribute->info().output || e.has(key)) continue;
    if (!dice_.chance(shareOf(*attribute, share))) continue;
    Proportions body = proportions_;
    // of one number a particle there are as many
    if (attribute->info().autolink && dice_.chance(0.9)) body.entries = body_.particles;
    e.set(key, value_.of(*attribute, body));
  }
  for (LinkBase* link : kind.prototype->links()) {
    if (!e.has(std::string(link->name()))) setLink(e, *link);
  }
  place(e, node);
  return e;
}

void SceneMaker::setLink(Element& e, LinkBase& link) {
  const bool mustBe = link.lookup() == Lookup::explicitOnly && link.info().required;
  if (!dice_.chance(mustBe ? (manner_ == Manner::broken ? 0.97 : 1.0) : 0.06)) return;
  std::vector<std::string> fitting;
  for (const Placed& p : placed_) {
    if (link.accepts(*p.kind->prototype)) fitting.push_back(p.path);
  }
  if (manner_ == Manner::broken && dice_.chance(0.05)) fitting.assign(1, "/nobody");
  if (fitting.empty()) return;
  e.set(std::string(link.name()), "@" + dice_.oneOf(fitting));
}

void SceneMaker::place(const Element& e, const std::string& node) {
  const auto name = std::ranges::find(e.attributes, "name", &Given::value_type::first);
  if (name == e.attributes.end()) return;
  const std::string path = node + "/" + name->second;
  for (const Element& child : e.children) place(child, path);
  if (const Kind* kind = catalogue_.find(e.type)) placed_.push_back({kind, path});
}

// A hand that wanders about the body, sometimes by leaps.
Element SceneMaker::device(const std::string& name) {
  const int keys = dice_.whole(2, 6);
  const double end = scene_.steps * proportions_.dt;
  std::vector<Vec3> path;
  std::string times;
  for (int i = 0; i < keys; ++i) {
    // one that cuts comes from outside and goes through
    const bool inside = !wantsCuts_ || (i > 0 && i + 1 < keys);
    const Vec3 at = inside ? dice_.vector(-0.4, 1.4) : dice_.vector(-0.2, 1) + Vec3(0, 0, 0.6);
    path.push_back(body_.low + at * body_.length);
    times += (i ? " " : "") + textOf(end * (i + dice_.uniform(0, 0.9)) / keys);
  }
  const auto devices = catalogue_.playing<HapticDevice>();
  const Kind& kind =
      *(dice_.chance(0.75) ? catalogue_.find("ScriptedDevice") : dice_.oneOf(devices));
  Given given = {{"keyTimes", times}, {"positions", textOf(path)}};
  if (dice_.chance(0.5)) given.emplace_back("rotations", textOf(dice_.vector(-180, 180)));
  if (dice_.chance(0.5)) {
    std::string buttons = "1";
    for (int i = 1; i < keys; ++i) buttons += " " + std::to_string(dice_.whole(0, 1));
    given.emplace_back("buttons", buttons);
  }
  return element(kind, name, "", given, 0.03);
}

void SceneMaker::addTools(Element& root) {
  wantsCuts_ = body_.canBeCut && dice_.chance(0.6);
  const int count = wantsCuts_ || dice_.chance(0.4) ? dice_.whole(1, 2) : 0;
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i + 1);
    root.children.push_back(device("hand" + number));
    const Kind& kind =
        *(wantsCuts_ && dice_.chance(0.7) ? catalogue_.find("ScalpelTool") : any<Tool>());
    Given given = {
        {"device", "@/hand" + number},
        {"radius", textOf(proportions_.length * dice_.decades(0.02, 0.5))},
        {"length", textOf(proportions_.length * dice_.decades(wantsCuts_ ? 0.5 : 0.1, 2))},
        {"diameter", textOf(proportions_.length * dice_.decades(0.1, 1))}};
    root.children.push_back(element(kind, "tool" + number, "", given));
  }
  if (count > 0 && dice_.chance(0.1)) {
    if (const Kind* controller = catalogue_.find("HapticController")) {
      Element& tool = root.children.back();
      std::erase_if(tool.attributes, [](const auto& a) { return a.first == "device"; });
      root.children.push_back(element(*controller, "controller", ""));
    }
  }
}

void SceneMaker::addMass(Element& body) {
  const Kind& kind = *any<Mass>();
  std::vector<std::string> ways;
  for (const AttributeBase* a : kind.prototype->attributes()) {
    if (a->typeName() == "number" && a->info().unit.substr(0, 2) == "kg")
      ways.emplace_back(a->name());
  }
  Given given;
  if (!ways.empty()) {
    const std::string way = dice_.oneOf(ways);
    given.emplace_back(way, value_.of(*kind.prototype->attribute(way), proportions_));
  }
  body.children.push_back(element(kind, "mass", "/body", given, 0.01));
}

void SceneMaker::addElasticity(Element& body) {
  const Kind& integrator = *catalogue_.find(scene_.integrator);
  std::vector<const Kind*> kinds = catalogue_.elasticities(integrator);
  // where there is nothing but points only what needs no elements can work
  const bool needsPoints = !body_.hasElements && dice_.chance(0.95);
  if (needsPoints) {
    std::erase_if(kinds, [](const Kind* kind) {
      return std::ranges::any_of(kind->prototype->links(), [](const LinkBase* link) {
        return link->name() == "topology" && link->info().required;
      });
    });
  }
  if (kinds.empty()) return;
  const Kind* kind = dice_.oneOf(kinds);
  if (const Kind* points = catalogue_.find("MLSForceField");
      points && std::ranges::find(kinds, points) != kinds.end() &&
      dice_.chance(wantsCuts_ ? 1 : 0.5)) {
    kind = points;
  }
  scene_.elasticity = kind->name;
  Given given;
  const bool isSampled = std::ranges::any_of(
      body_.elements, [](const Element& e) { return e.type == "ParticleSampler"; });
  if (isSampled && kind->name == "MLSForceField") given.emplace_back("src", "@points");
  if (!body_.surface.empty() && dice_.chance(0.7)) given.emplace_back("surface", body_.surface);
  body.children.push_back(element(*kind, "elasticity", "/body", given));
  if (kinds.size() > 1 && dice_.chance(0.08)) {
    body.children.push_back(element(*dice_.oneOf(kinds), "elasticity2", "/body"));
  }
}

void SceneMaker::addSupports(Element& body) {
  const Kind* roi = catalogue_.find(dice_.chance(0.7) ? "BoxROI" : "SphereROI");
  Given given;
  const Vec3 low = body_.low - Vec3::Constant(0.1 * body_.length);
  Vec3 high = body_.low + Vec3::Constant(1.1 * body_.length);
  const int axis = dice_.whole(0, 2);
  high[axis] = body_.low[axis] + dice_.uniform(0, 0.5) * body_.length;
  if (roi->name == "BoxROI") given.emplace_back("box", textOf(low) + " " + textOf(high));
  body.children.push_back(element(*roi, "region", "/body", given, 0.03));
  for (int i = dice_.whole(0, 2); i > 0; --i) {
    const Kind& kind = *any<ProjectiveConstraint>();
    Given held;
    if (dice_.chance(0.8)) held.emplace_back("indices", "@region.indices");
    body.children.push_back(element(kind, "support" + std::to_string(i), "/body", held, 0.05));
  }
}

void SceneMaker::addSurface(Element& body) {
  if (body_.surface.empty() || scene_.elasticity != "MLSForceField") return;
  if (!wantsCuts_ && dice_.chance(0.3)) return;
  Element node{"Node", {{"name", "surface"}}, {}};
  const std::string here = "/body/surface";
  node.children.push_back(
      element(*catalogue_.find("MeshTopology"), "mesh", here, {{"src", body_.surface}}, 0.0));
  node.children.push_back(element(*catalogue_.find("MechanicalObject"), "nodes", here, {}, 0.0));
  node.children.push_back(element(*any<Mapping>(), "mapping", here, {}, 0.1));
  for (int i = dice_.whole(0, 1); i > 0; --i) {
    node.children.push_back(element(*any<ForceField>(), "load" + std::to_string(i), here));
  }
  body.children.push_back(std::move(node));
  hasSurface_ = true;
}

void SceneMaker::addContactAndCuts(Element& body) {
  std::string tools;
  for (const Placed& p : placed_) {
    if (dynamic_cast<const Tool*>(p.kind->prototype.get()))
      tools += (tools.empty() ? "@" : " @") + p.path;
  }
  if (tools.empty() || body_.surface.empty()) return;
  const Given onSurface = {{"state", "@/body/surface/nodes"}, {"topology", "@/body/surface/mesh"}};
  const bool direct = !hasSurface_ || (body_.surface == "@/body/points" && dice_.chance(0.2));
  if (dice_.chance(0.8)) {
    body.children.push_back(
        element(*any<CollisionModel>(), "collision", "/body", direct ? Given{} : onSurface, 0));
    body.children.push_back(element(*catalogue_.find("PenaltyContactForceField"), "contact",
                                    "/body", {{"tools", tools}}));
  }
  if (!hasSurface_ || dice_.chance(0.25)) return;
  Given given = {{"tools", tools},
                 {"surfaceState", "@/body/surface/nodes"},
                 {"topology", "@/body/surface/mesh"}};
  if (!body_.solid.empty()) given.emplace_back("solid", body_.solid);
  body.children.push_back(element(*any<TopologyModifier>(), "cut", "/body", given, 0.05));
  if (dice_.chance(0.5)) {
    body.children.push_back(element(*catalogue_.find("CuttingResistance"), "resistance", "/body"));
  }
}

// Anything at all, as somebody might try it.
void SceneMaker::addExtras(Element& body) {
  for (int i = dice_.whole(0, 2); i > 0; --i) {
    body.children.push_back(element(*any<ForceField>(), "extra" + std::to_string(i), "/body"));
  }
  for (int i = dice_.whole(0, 1); i > 0; --i) {
    body.children.push_back(
        element(*any<Observer>(), "watch" + std::to_string(i), "/body", {}, 0.2));
  }
  if (dice_.chance(manner_ == Manner::sensible ? 0.05 : 0.3)) {
    body.children.push_back(element(dice_.oneOf(catalogue_.kinds()), "odd", "/body"));
  }
}

Element SceneMaker::bodyNode() {
  Element body{"Node", {{"name", "body"}}, {}};
  const Kind& integrator = *anyIntegrator();
  scene_.integrator = integrator.name;
  if (integrator.prototype->link("linearSolver") &&
      (manner_ != Manner::broken || dice_.chance(0.95))) {
    body.children.push_back(element(*any<LinearSolver>(), "linear", "/body"));
  }
  body.children.push_back(element(integrator, "solver", "/body"));
  for (const Element& e : body_.elements) {
    body.children.push_back(e);
    place(e, "/body");
    if (e.type != "MechanicalObject" || !dice_.chance(0.2)) continue;
    Element& state = body.children.back();
    if (dice_.chance(0.5)) {
      state.set("velocity", textOf(Vec3(dice_.vector(-1, 1) * dice_.decades(1e-3, 10))));
    } else if (const Kind* start = catalogue_.find("InitialMotion");
               start && state.attributes.size() == 1) {
      const Element motion =
          element(*start, "start", "/body", {{"points", "@points.position"}}, 0.2);
      body.children.insert(body.children.end() - 1, motion);
      body.children.back()
          .set("rest_position", "@points.position")
          .set("position", "@start.position");
      body.children.back().set("velocity", "@start.velocity");
    }
  }
  addMass(body);
  addElasticity(body);
  addSupports(body);
  addSurface(body);
  addContactAndCuts(body);
  addExtras(body);
  return body;
}

void SceneMaker::addActions() {
  std::vector<std::pair<const AttributeBase*, std::string>> settable;
  for (const Placed& p : placed_) {
    for (const AttributeBase* a : p.kind->prototype->attributes()) {
      if (a->info().runtime) settable.emplace_back(a, p.path + "." + std::string(a->name()));
    }
  }
  if (settable.empty() || dice_.chance(0.4)) return;
  for (int i = dice_.whole(1, 3); i > 0; --i) {
    const auto& [attribute, path] = dice_.oneOf(settable);
    scene_.actions.push_back({Action::Kind::set, dice_.whole(1, scene_.steps - 1), path,
                              value_.of(*attribute, proportions_)});
  }
  if (dice_.chance(0.2)) {
    const int half = scene_.steps / 2;
    const int saved = dice_.whole(0, half);
    scene_.actions.push_back({Action::Kind::save, saved, "", ""});
    scene_.actions.push_back(
        {Action::Kind::restore, dice_.whole(saved + 1, scene_.steps - 1), "", ""});
  }
  if (dice_.chance(0.1)) {
    scene_.actions.push_back({Action::Kind::reset, dice_.whole(1, scene_.steps - 1), "", ""});
  }
  std::ranges::stable_sort(scene_.actions, {}, &Action::step);
}

RandomScene SceneMaker::make(const TrialFolders& folders, const Mending::LookAt& before) {
  scene_.manner = nameOf(manner_);
  body_ = randomBody(dice_, manner_ != Manner::sensible || dice_.chance(0.15));
  scene_.steps = dice_.whole(4, 40);
  proportions_ = {body_.length, dice_.decades(1e-5, 1e-1), body_.particles};
  const Vec3 gravity = dice_.chance(0.5) ? Vec3(Vec3::Zero()) : dice_.vector(-10, 10);
  Element root{"Node",
               {{"name", "root"},
                {"dt", textOf(proportions_.dt)},
                {"duration", textOf(proportions_.dt * scene_.steps)},
                {"gravity", textOf(gravity)}},
               {}};
  if (manner_ == Manner::broken && dice_.chance(0.1)) {
    root.set("dt", dice_.oneOf({"0", "-1e-3", "nan", "inf", "1e300", "1e-300", "1e9"}));
  }
  if (manner_ == Manner::broken && dice_.chance(0.05)) root.set("units", "mm g s");
  if (dice_.chance(0.5)) root.children.push_back(element(*any<AnimationLoop>(), "loop", ""));
  addTools(root);
  root.children.push_back(bodyNode());
  // broken scenes are left as they are, most others shall run
  const int rounds = manner_ == Manner::broken || dice_.chance(0.1) ? 0 : 12;
  Mending(catalogue_, folders, dice_, proportions_, before).mend(root, rounds);
  placed_.clear();
  for (const Element& child : root.children) place(child, "");
  addActions();
  scene_.text = "<?xml version=\"1.0\"?>\n" + textOf(root);
  for (const Action& a : scene_.actions) {
    constexpr std::array<const char*, 4> words = {"set ", "reset", "save", "restore"};
    std::string value = a.value;  // two hyphens would end the comment
    for (std::size_t at; (at = value.find("--")) != std::string::npos;) value.erase(at, 1);
    scene_.text += "<!-- before step " + std::to_string(a.step + 1) + ": " +
                   words[static_cast<std::size_t>(a.kind)] + a.path +
                   (a.path.empty() ? "" : " = " + value) + " -->\n";
  }
  return std::move(scene_);
}

}  // namespace

RandomScene randomScene(const Catalogue& catalogue, const TrialFolders& folders, std::uint64_t seed,
                        const Mending::LookAt& before) {
  return SceneMaker(catalogue, seed).make(folders, before);
}

}  // namespace stroma::fuzz
