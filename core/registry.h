// SPDX-License-Identifier: Apache-2.0
// The components that exist: name -> creator, help, origin. Modules fill it by an explicit
// function; there are no static initialisers and no process-wide instance.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/component.h"

namespace stroma {

struct ComponentEntry {
  std::string name;
  std::string doc;      // what it does, one paragraph
  std::string domain;   // where its results are valid, and what was verified
  std::string example;  // a shipped scene that shows it
  std::string origin;   // module it comes from
  std::vector<std::string> aliases;
  std::vector<std::string> dataTypes;  // accepted values of template="..."
  std::function<std::unique_ptr<Component>()> create;
};

// Filled in at registration: registry.add<T>("Name").doc("...").alias("OldName").
class ComponentRegistration {
 public:
  explicit ComponentRegistration(ComponentEntry& entry) : entry_(entry) {}
  ComponentRegistration& doc(std::string text) { return entry_.doc = std::move(text), *this; }
  ComponentRegistration& domain(std::string text) { return entry_.domain = std::move(text), *this; }
  ComponentRegistration& example(std::string scene) {
    return entry_.example = std::move(scene), *this;
  }
  ComponentRegistration& alias(std::string name) {
    return entry_.aliases.push_back(std::move(name)), *this;
  }

 private:
  ComponentEntry& entry_;
};

class Registry {
 public:
  template <class T>
  ComponentRegistration add(std::string name) {
    return insert(std::move(name), [] { return std::make_unique<T>(); });
  }
  // Origin noted for the entries that follow.
  void setOrigin(std::string module) { origin_ = std::move(module); }

  [[nodiscard]] const ComponentEntry* find(std::string_view nameOrAlias) const;
  [[nodiscard]] std::unique_ptr<Component> create(const ComponentEntry& entry) const;
  [[nodiscard]] const std::map<std::string, ComponentEntry, std::less<>>& entries() const {
    return entries_;
  }
  // Names registered twice, as "Name (first from A, again from B)".
  [[nodiscard]] const std::vector<std::string>& conflicts() const { return conflicts_; }

 private:
  ComponentRegistration insert(std::string name,
                               std::function<std::unique_ptr<Component>()> create);
  std::map<std::string, ComponentEntry, std::less<>> entries_;
  std::vector<std::string> conflicts_;
  std::string origin_;
};

}  // namespace stroma
