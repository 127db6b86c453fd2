// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/catalogue.h"

#include <algorithm>

#include "core/interfaces/force_field.h"
#include "core/interfaces/viewer.h"

namespace stroma::fuzz {
namespace {

SceneOptions modulesOf(const std::filesystem::path& folder) {
  SceneOptions options;
  options.pluginFolders = {folder};
  return options;
}

// What opens connections has no place in scenes that run by the thousand, side by side.
bool isConnected(const Component& component) {
  return dynamic_cast<const Viewer*>(&component) || component.attribute("port");
}

bool worksOnItsNodesMesh(const Component& component) {
  return std::ranges::any_of(component.links(), [](const LinkBase* link) {
    return link->name() == "topology" && link->lookup() == Lookup::sameNode;
  });
}

}  // namespace

Catalogue::Catalogue(const std::filesystem::path& modules) : scene_(modulesOf(modules)) {
  for (const ModuleManifest& module : scene_.modules().modules()) {
    std::string problem;
    if (!scene_.modules().load(module, scene_.registry(), problem)) problems_.push_back(problem);
  }
  for (const auto& [name, entry] : scene_.registry().entries()) {
    Kind kind{name, entry.origin, scene_.registry().create(entry)};
    if (!isConnected(*kind.prototype)) kinds_.push_back(std::move(kind));
  }
}

const Kind* Catalogue::find(std::string_view name) const {
  const auto found = std::ranges::find(kinds_, name, &Kind::name);
  return found == kinds_.end() ? nullptr : &*found;
}

std::vector<const Kind*> Catalogue::elasticities(const Kind& integrator) const {
  std::vector<const Kind*> fields, constraints;
  for (const Kind& kind : kinds_) {
    if (!worksOnItsNodesMesh(*kind.prototype)) continue;
    if (dynamic_cast<const ForceField*>(kind.prototype.get())) {
      fields.push_back(&kind);
    } else if (kind.module == integrator.module) {
      constraints.push_back(&kind);
    }
  }
  return constraints.empty() ? fields : constraints;
}

}  // namespace stroma::fuzz
