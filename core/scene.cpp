// SPDX-License-Identifier: Apache-2.0
#include "core/scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>

#include "core/interfaces/integrator.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/topology_modifier.h"
#include "core/path.h"
#include "core/scene_reader.h"
#include "core/scene_text.h"
#include "core/traverse.h"

namespace stroma {
namespace {

// Number of periods that have ended by step n: exact for any n, so slower and faster rates never
// drift.
std::uint64_t ticks(std::uint64_t step, double dt, double rate) {
  return static_cast<std::uint64_t>(std::floor(static_cast<double>(step) * dt * rate + 1e-9));
}

std::uint64_t hashElement(const SceneElement& element, std::uint64_t hash) {
  const auto add = [&](const std::string& text) {
    hash = hashBytes(std::as_bytes(std::span(text.data(), text.size() + 1)), hash);
  };
  add(element.tag);
  for (const SceneAttribute& a : element.attributes) {
    add(a.name);
    add(a.value);
  }
  for (const SceneElement& child : element.children) hash = hashElement(child, hash);
  add("/");  // the end of the element: the same children elsewhere are another scene
  return hash;
}

// Topologies follow a cut first, then who computes with links, then who moves the new nodes.
int followRank(const Component& component) {
  if (dynamic_cast<const Mesh*>(&component)) return 0;
  if (dynamic_cast<const ForceField*>(&component)) return 1;
  return dynamic_cast<const Mapping*>(&component) ? 2 : 3;
}

// A library's exception in a component's hook becomes an error at its element.
template <class Hook>
void guarded(Component& component, Hook&& hook) {
  try {
    hook();
  } catch (const std::exception& e) {
    component.error("component-failed", std::string("cannot be set up: ") + e.what());
  }
}

}  // namespace

Scene::Scene(SceneOptions options)
    : options_(std::move(options)),
      modules_(options_.pluginFolders),
      root_(std::make_unique<Node>(*this, nullptr)) {
  root_->setName("root");
  for (const std::string& problem : modules_.problems()) {
    diagnostics_.warning("plugin-manifest", problem);
  }
}

Scene::~Scene() { stop(); }

bool Scene::load(const std::filesystem::path& file) {
  file_ = file;
  return readInto(readSceneFile(file, options_.dataFolders, diagnostics_));
}

bool Scene::load(const SceneElement& root, const std::filesystem::path& file) {
  file_ = file;
  return readInto(root);
}

bool Scene::loadText(std::string text, const std::filesystem::path& file) {
  file_ = file;
  return readInto(readSceneText(std::move(text), file, options_.dataFolders, diagnostics_));
}

bool Scene::readInto(const std::optional<SceneElement>& element) {
  if (!element) return false;
  contentHash_ = hashElement(*element, hashBytes({}));
  for (const std::string& assignment : options_.overrides) {
    contentHash_ =
        hashBytes(std::as_bytes(std::span(assignment.data(), assignment.size() + 1)), contentHash_);
  }
  SceneReader(*this).read(*element, options_.overrides);
  return diagnostics_.errorCount() == 0;
}

std::vector<Component*> Scene::dependencyOrder() {
  std::vector<Component*> order, open;
  std::map<const Component*, int> mark;  // 1 = being visited, 2 = done
  const std::function<void(Component&)> visit = [&](Component& component) {
    int& own = mark[&component];
    if (own == 2) return;
    if (own == 1) {
      std::string cycle;
      auto from = std::ranges::find(open, &component);
      for (; from != open.end(); ++from) cycle += (*from)->path() + " -> ";
      component.error("link-cycle", "is linked in a cycle: " + cycle + component.path());
      return;
    }
    own = 1;
    open.push_back(&component);
    for (const LinkBase* link : component.links()) {
      for (Component* target : link->components()) visit(*target);
    }
    for (const AttributeBase* a : component.attributes()) {
      if (!a->source()) continue;
      if (auto* target = dynamic_cast<Component*>(&a->source()->owner())) visit(*target);
    }
    open.pop_back();
    mark[&component] = 2;
    order.push_back(&component);
  };
  forEachComponent(*root_, visit);
  return order;
}

bool Scene::initialise() {
  if (diagnostics_.errorCount() > 0) return false;
  const std::vector<Component*> order = dependencyOrder();
  for (Component* component : order) guarded(*component, [&] { component->configure(); });
  for (Component* component : order) {
    // a failure below is reported once, where it is, not again by all that depends on it
    for (const LinkBase* link : component->links()) {
      for (const Component* target : link->components()) component->failed_ |= target->failed();
    }
    for (AttributeBase* a : component->attributes()) {
      if (!a->source()) continue;
      const auto* source = dynamic_cast<const Component*>(&a->source()->owner());
      if (source && source->failed()) component->failed_ = true;
      if (component->failed_) break;
      if (auto problem = a->pull()) {
        component->error(*a, problem->id,
                         "cannot take the value of '" + a->source()->owner().path() + "." +
                             std::string(a->source()->name()) + "' (" + a->source()->typeName() +
                             "): " + problem->message,
                         problem->hint);
      }
    }
    if (!component->failed()) guarded(*component, [&] { component->bind(); });
  }
  if (diagnostics_.errorCount() > 0) return false;
  compile();
  if (diagnostics_.errorCount() > 0) return false;
  followers_ = order;
  std::ranges::stable_sort(followers_, {}, [](Component* c) { return followRank(*c); });
  running_ = true;
  for (Component* component : order) guarded(*component, [&] { component->start(); });
  for (const auto& system : systems_) system->updateMapped();
  return diagnostics_.errorCount() == 0;
}

void Scene::compile() {
  for (Integrator* integrator : collect<Integrator>(*root_)) {
    const auto here = collectHere<Integrator>(integrator->node());
    if (here.size() > 1 && here.front() != integrator) {
      integrator->error("solver-second", "node '" + integrator->node().path() +
                                             "' has a solver already, '" + here.front()->name() +
                                             "'");
      continue;
    }
    systems_.push_back(std::make_unique<System>(*integrator));
    integrator->setSystem(systems_.back().get());
  }
  for (MechanicalState* state : collect<MechanicalState>(*root_)) {
    if (systemOf(*state)) continue;
    state->error("state-ungoverned",
                 "no solver governs this state: add one, such as EulerImplicitSolver, to its node "
                 "or above");
  }
  const auto loops = collect<AnimationLoop>(*root_);
  if (!loops.empty()) rates_ = loops.front()->rates();
  for (std::size_t i = 1; i < loops.size(); ++i) {
    loops[i]->error("loop-second",
                    "a scene has one animation loop; there is '" + loops.front()->path() + "'");
  }
  // mappings in the order in which they depend on each other, everything else as it is written
  for (const auto& system : systems_) system->scheduleMappings(schedule_);
  forEachComponent(*root_, [&](Component& c) {
    if (!dynamic_cast<Mapping*>(&c)) c.schedule(schedule_);
  });
  for (int s = 0; s < stageCount; ++s) {
    for (const Schedule::Entry& e : schedule_.stage(static_cast<Stage>(s))) {
      profiler_.rows(s).push_back({std::string(stageName(static_cast<Stage>(s))),
                                   e.component->path(),
                                   std::string(e.label),
                                   {}});
    }
  }
  for (const auto& system : systems_) guards_.emplace_back(*system);
}

double Scene::timeAt(std::uint64_t step) const {
  return root_->time + static_cast<double>(step) * root_->dt;
}

bool Scene::step() {
  if (divergence_) return false;
  const auto begin = std::chrono::steady_clock::now();
  const std::uint64_t next = step_ + 1;
  StepContext context{timeAt(step_), dt(), next};
  const bool visual =
      rates_.visual <= 0 || ticks(next, dt(), rates_.visual) > ticks(step_, dt(), rates_.visual);
  const int haptic =
      rates_.haptic <= 0
          ? 1
          : static_cast<int>(ticks(next, dt(), rates_.haptic) - ticks(step_, dt(), rates_.haptic));
  const auto run = [&](Stage stage) { schedule_.run(stage, context, visual, haptic, profiler_); };
  run(Stage::Input);
  run(Stage::Topology);
  run(Stage::Predict);
  run(Stage::Collide);
  run(Stage::Solve);
  context.time = timeAt(next);
  const auto guardBegin = std::chrono::steady_clock::now();
  for (FiniteGuard& guard : guards_) {
    divergence_ = guard.check(next, context.time, dt());
    if (divergence_) {
      for (FiniteGuard& other : guards_) other.restoreLastGood();
      return false;
    }
  }
  for (FiniteGuard& guard : guards_) guard.accept();
  profiler_.stage(static_cast<int>(Stage::Guard))
      .add(std::chrono::steady_clock::now() - guardBegin);
  step_ = next;
  run(Stage::Map);
  run(Stage::Guard);
  run(Stage::Publish);
  profiler_.step().add(std::chrono::steady_clock::now() - begin);
  return true;
}

void Scene::stop() {
  if (!running_) return;
  running_ = false;
  forEachComponent(*root_, [](Component& c) { c.stop(); });
}

void Scene::changeTopology(const TopologyChange& change) {
  topologyChanged_ = true;
  if (!change.edit.nodes.empty()) {
    std::vector<Vec3> rest;
    for (const NewSurfaceNode& node : change.edit.nodes) rest.push_back(node.rest);
    const bool grown = std::ranges::any_of(
        systems_, [&](const auto& system) { return system->grow(change.nodes, rest); });
    if (!grown) throw std::logic_error("a surface that is cut must be a mapped state");
  }
  for (Component* component : followers_) component->topologyChanged(change);
}

void Scene::checkTopology(TopologyCheck& check) const {
  for (const Component* component : followers_) component->checkTopology(check);
}

// The bodies whole again; positions and what depends on them are for the caller.
void Scene::restoreTopology() {
  if (!topologyChanged_) return;
  topologyChanged_ = false;
  for (const auto& system : systems_) system->dropAppended();
  for (Component* component : followers_) component->topologyRestored();
}

void Scene::reset() {
  step_ = 0;
  divergence_.reset();
  restoreTopology();
  for (const auto& system : systems_) system->reset();
  for (FiniteGuard& guard : guards_) guard.accept();
  forEachComponent(*root_, [](Component& c) {
    for (Limiter* limiter : c.limiters()) limiter->reset();
    c.reset();
  });
}

Snapshot Scene::save() const {
  Snapshot snapshot;
  snapshot.step = step_;
  snapshot.time = time();
  for (const auto& system : systems_) {
    StateWriter writer(snapshot.chunks, system->integrator().path());
    writer.write("system.x", ConstVec3Span(system->x()));
    writer.write("system.v", ConstVec3Span(system->v()));
    writer.write("system.f", ConstVec3Span(system->f()));
  }
  forEachComponent(*root_, [&](Component& c) {
    StateWriter writer(snapshot.chunks, c.path());
    for (const Limiter* limiter : c.limiters()) {
      writer.write("limiter." + std::string(limiter->name()), limiter->count());
    }
    c.save(writer);
  });
  return snapshot;
}

bool Scene::restore(const Snapshot& snapshot) {
  for (const auto& system : systems_) {
    const StateReader reader(snapshot.chunks, system->integrator().path());
    const auto size = static_cast<std::size_t>(3 * system->size());
    if (reader.count<double>("system.x") != size || reader.count<double>("system.v") != size ||
        reader.count<double>("system.f") != size) {
      return false;
    }
  }
  step_ = snapshot.step;
  divergence_.reset();
  restoreTopology();
  for (TopologyModifier* modifier : collect<TopologyModifier>(*root_)) {
    StateReader reader(snapshot.chunks, modifier->path());
    modifier->replay(reader);
  }
  for (const auto& system : systems_) {
    const StateReader reader(snapshot.chunks, system->integrator().path());
    const bool read = reader.read("system.x", system->x()) &&
                      reader.read("system.v", system->v()) && reader.read("system.f", system->f());
    if (!read) return false;
    system->updateMapped();
  }
  for (FiniteGuard& guard : guards_) guard.accept();
  forEachComponent(*root_, [&](Component& c) {
    StateReader reader(snapshot.chunks, c.path());
    for (Limiter* limiter : c.limiters()) {
      std::uint64_t count = 0;
      if (reader.read("limiter." + std::string(limiter->name()), count)) limiter->reset(count);
    }
    c.restore(reader);
  });
  return true;
}

std::uint64_t Scene::stateHash() const {
  std::uint64_t hash = hashBytes({});
  for (const auto& system : systems_) {
    for (const Vec3Span span : {system->x(), system->v()}) {
      hash = hashBytes(std::as_bytes(span), hash);
    }
  }
  return hash;
}

std::optional<std::string> Scene::setAttribute(const std::string& path, const std::string& value) {
  std::string problem, hint;
  const auto [component, attribute] = findAttribute(*root_, path, problem, hint);
  if (!attribute) return problem;
  if (!attribute->info().runtime) {
    return "'" + std::string(attribute->name()) + "' cannot be changed while the scene runs";
  }
  if (auto error = attribute->parse(value, UnitSystem{})) return error->message;
  if (component) component->attributeChanged(*attribute);
  for (const auto& system : systems_) system->integrator().systemChanged();
  return std::nullopt;
}

System* Scene::systemOf(const MechanicalState& state) const {
  for (const auto& system : systems_) {
    const auto states = system->states();
    if (std::ranges::find(states, &state) != states.end()) return system.get();
    const auto mapped = system->mappedStates();
    if (std::ranges::find(mapped, &state) != mapped.end()) return system.get();
  }
  return nullptr;
}

Index Scene::particleCount() const {
  Index count = 0;
  for (const auto& system : systems_) count += system->size();
  return count;
}

std::optional<std::filesystem::path> Scene::findInput(Component& component,
                                                      const Attribute<FilePath>& attribute) {
  std::string searched;
  auto found = findFile(attribute->path, file_.parent_path(), options_.dataFolders, searched);
  if (!found) {
    component.error(attribute, "file-missing",
                    "names a file that is not there: '" + attribute->path + "'",
                    "searched: " + searched);
    return found;
  }
  // a checkpoint belongs to the meshes, too
  std::ifstream stream(*found, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  contentHash_ = hashBytes(std::as_bytes(std::span(bytes)), contentHash_);
  return found;
}

}  // namespace stroma
