// SPDX-License-Identifier: Apache-2.0
#include "core/registry.h"

#include <algorithm>

namespace stroma {

ComponentRegistration Registry::insert(std::string name,
                                       std::function<std::unique_ptr<Component>()> create) {
  const auto known = entries_.find(name);
  if (known != entries_.end()) {
    conflicts_.push_back(name + " (first from " + known->second.origin + ", again from " + origin_ +
                         ")");
    return ComponentRegistration(known->second);
  }
  ComponentEntry& entry = entries_[name];
  entry.name = std::move(name);
  entry.origin = origin_;
  entry.dataTypes = {"Vec3", "Vec3d", "Vec3f"};
  entry.create = std::move(create);
  return ComponentRegistration(entry);
}

const ComponentEntry* Registry::find(std::string_view nameOrAlias) const {
  const auto direct = entries_.find(nameOrAlias);
  if (direct != entries_.end()) return &direct->second;
  for (const auto& [name, entry] : entries_) {
    if (std::ranges::find(entry.aliases, nameOrAlias) != entry.aliases.end()) return &entry;
  }
  return nullptr;
}

std::unique_ptr<Component> Registry::create(const ComponentEntry& entry) const {
  std::unique_ptr<Component> component = entry.create();
  component->type_ = entry.name;
  return component;
}

}  // namespace stroma
