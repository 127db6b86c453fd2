// SPDX-License-Identifier: Apache-2.0
// A component: a named unit of behaviour in one node of the scene. It declares its attributes and
// links as members and overrides the hooks it needs; what it does in a step it says once, in
// schedule().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/attribute_owner.h"

namespace stroma {

class Component;
class Node;
class Scene;
class Schedule;
class StateReader;
class StateWriter;
struct StepContext;
struct TopologyChange;
struct TopologyCheck;

// Counts how often a limiter acted (an iteration cap, a force clamp, ...). Limiters that acted are
// named in the run's summary: nothing is limited silently.
class Limiter {
 public:
  Limiter(Component* owner, std::string_view name, std::string_view doc);
  Limiter(const Limiter&) = delete;
  Limiter& operator=(const Limiter&) = delete;
  void operator++() { ++count_; }
  void add(std::uint64_t n) { count_ += n; }
  void reset(std::uint64_t n = 0) { count_ = n; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] std::string_view doc() const { return doc_; }

 private:
  std::string_view name_, doc_;
  std::uint64_t count_ = 0;
};

class Component : public AttributeOwner {
 public:
  static constexpr std::string_view role = "Component";

  // Life cycle, in this order. Problems are reported with error(); nothing is thrown.
  virtual void configure() {}  // own attributes are set: check them against each other
  virtual void bind() {}       // what this links to is bound: read inputs, compute outputs
  virtual void start() {}      // everything is bound and the solvers' state is laid out
  virtual void reset() {}      // time and states are back at the start
  virtual void stop() {}       // the run has ended, also after a failure: close files

  // Adds the calls that this component makes in every step. None: it costs nothing in a step.
  virtual void schedule(Schedule&) {}
  // A run-time attribute has a new value.
  virtual void attributeChanged(const AttributeBase&) {}
  // A body has been cut: what this keeps of its nodes, triangles and links follows, at a cost
  // proportional to the change. Called in this order: topologies, then (its states have their new
  // nodes) force fields, mappings, everything else; within each what a component links to first.
  virtual void topologyChanged(const TopologyChange&) {}
  // All bodies are whole again: drops what topologyChanged() has made. In the same order, before
  // reset() and restore(), only if something had been cut.
  virtual void topologyRestored() {}
  // Adds what is wrong with what this keeps of a body that has been cut. May be as slow as need be.
  virtual void checkTopology(TopologyCheck&) const {}
  // State beyond the particles' positions and velocities, for exact resumption.
  virtual void save(StateWriter&) const {}
  virtual void restore(StateReader&) {}

  [[nodiscard]] const std::string& type() const { return type_; }
  [[nodiscard]] Node& node() const { return *node_; }
  [[nodiscard]] Scene& scene() const;
  [[nodiscard]] std::string describe() const override;
  [[nodiscard]] std::string path() const override;
  [[nodiscard]] const std::vector<Limiter*>& limiters() const { return limiters_; }
  [[nodiscard]] bool verbose() const { return verbose_; }
  // Whether an error was reported for this component; those that depend on it are then not bound.
  [[nodiscard]] bool failed() const { return failed_; }
  // Whether a warning was reported for it: what follows from the same fault need not warn again.
  [[nodiscard]] bool warned() const { return warned_; }

  // Diagnostics that point at this component's element, or at where the attribute or link was
  // written.
  void error(std::string id, std::string message, std::string hint = "");
  void error(const AttributeBase& attribute, std::string id, std::string message,
             std::string hint = "");
  void error(const LinkBase& link, std::string id, std::string message, std::string hint = "");
  void warning(std::string id, std::string message, std::string hint = "");
  void note(std::string id, std::string message);

 private:
  friend class Limiter;
  friend class Node;
  friend class Registry;
  friend class Scene;
  friend class SceneReader;
  std::string type_;
  Node* node_ = nullptr;
  std::vector<Limiter*> limiters_;
  bool verbose_ = false;
  bool failed_ = false;
  bool warned_ = false;
};

}  // namespace stroma
