// SPDX-License-Identifier: Apache-2.0
#include "core/plugin.h"

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <cstdlib>
#include <fstream>

#include "core/interfaces/animation_loop.h"
#include "core/interfaces/collision_model.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/haptic_device.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/linear_solver.h"
#include "core/interfaces/mapping.h"
#include "core/interfaces/mass.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/projective_constraint.h"
#include "core/interfaces/tool.h"
#include "core/interfaces/topology_modifier.h"
#include "core/interfaces/viewer.h"
#include "core/json.h"

namespace stroma {
namespace fs = std::filesystem;
namespace {

// Why a plugin with these marks cannot be used here, empty when it can.
std::string mismatch(const std::string& name, int abi, std::string_view buildId) {
  if (abi != coreAbi) {
    return "plugin '" + name + "' was built for interface version " + std::to_string(abi) +
           ", this core has version " + std::to_string(coreAbi) + ": rebuild the plugin";
  }
  if (buildId != coreBuildId()) {
    return "plugin '" + name + "' was built as '" + std::string(buildId) + "', this core as '" +
           std::string(coreBuildId()) + "': rebuild the plugin with the same compiler and options";
  }
  return "";
}

std::map<fs::path, const PluginDescriptor*>& openLibraries() {
  static std::map<fs::path, const PluginDescriptor*> libraries;
  return libraries;
}

// The most particular first.
template <class... Interfaces>
std::string_view firstOf(const Component& component) {
  std::string_view role;
  static_cast<void>(
      ((dynamic_cast<const Interfaces*>(&component) ? (role = Interfaces::role, true) : false) ||
       ...));
  return role;
}

std::string_view roleOf(const Component& component) {
  return firstOf<AnimationLoop, CollisionModel, ForceField, HapticDevice, Integrator, LinearSolver,
                 Mapping, Mass, MechanicalState, Topology, Mesh, ProjectiveConstraint, Tool,
                 TopologyModifier, Viewer, Observer>(component);
}

}  // namespace

std::string_view coreBuildId() { return STROMA_BUILD_ID; }

const PluginDescriptor* loadPlugin(const fs::path& library, std::string& problem) {
  std::error_code ignored;
  const fs::path path = fs::weakly_canonical(library, ignored);
  auto& open = openLibraries();
  if (const auto known = open.find(path); known != open.end()) return known->second;

  boost::dll::fs::error_code failure;
  auto handle = std::make_unique<boost::dll::shared_library>(
      path.string(), boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, failure);
  if (failure) {
    problem = "cannot load '" + path.string() + "': " + failure.message();
    return nullptr;
  }
  if (!handle->has("stroma_plugin_descriptor")) {
    problem = "'" + path.string() + "' is not a plugin: it exports no descriptor";
    return nullptr;
  }
  const auto& descriptor = handle->get<const PluginDescriptor>("stroma_plugin_descriptor");
  if (descriptor.magic != pluginMagic || descriptor.size != sizeof(PluginDescriptor)) {
    problem =
        "'" + path.string() + "' has a plugin descriptor of another layout: rebuild the plugin";
    return nullptr;
  }
  problem = mismatch(descriptor.name, descriptor.abi, descriptor.buildId);
  if (!problem.empty()) return nullptr;
  open[path] = &descriptor;
  // never unloaded, not even at exit: components may outlive everything static here
  static auto& handles = *new std::vector<std::unique_ptr<boost::dll::shared_library>>;
  handles.push_back(std::move(handle));
  return &descriptor;
}

std::string manifestText(const PluginDescriptor& descriptor, const fs::path& library) {
  Registry registry;
  registry.setOrigin(descriptor.name);
  descriptor.registerComponents(registry);
  JsonWriter json;
  json.beginObject();
  json.key("name").value(descriptor.name);
  json.key("version").value(descriptor.version);
  json.key("license").value(descriptor.license);
  json.key("summary").value(descriptor.summary);
  json.key("abi").value(static_cast<int>(descriptor.abi));
  json.key("buildId").value(descriptor.buildId);
  json.key("library").value(library.filename().string());
  json.key("components").beginArray();
  for (const auto& [name, entry] : registry.entries()) {
    json.value(name);
    for (const std::string& alias : entry.aliases) json.value(alias);
  }
  json.endArray();
  json.key("roles").beginObject();
  for (const auto& [name, entry] : registry.entries()) {
    const std::string_view role = roleOf(*registry.create(entry));
    if (!role.empty()) json.member(name, role);
  }
  json.endObject();
  json.endObject();
  return json.text() + "\n";
}

ModuleIndex::ModuleIndex(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    std::vector<fs::path> manifests;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().string().ends_with(".plugin.json")) manifests.push_back(entry.path());
    }
    std::ranges::sort(manifests);
    for (const fs::path& path : manifests) {
      try {
        boost::property_tree::ptree tree;
        boost::property_tree::read_json(path.string(), tree);
        ModuleManifest m;
        m.name = tree.get<std::string>("name");
        m.version = tree.get<std::string>("version");
        m.license = tree.get<std::string>("license");
        m.summary = tree.get<std::string>("summary");
        m.buildId = tree.get<std::string>("buildId");
        m.abi = tree.get<int>("abi");
        m.library = path.parent_path() / tree.get<std::string>("library");
        for (const auto& item : tree.get_child("components")) {
          m.components.push_back(item.second.data());
        }
        if (const auto roles = tree.get_child_optional("roles")) {
          for (const auto& item : *roles) m.roles.emplace(item.first, item.second.data());
        }
        if (module(m.name)) continue;  // an earlier folder wins
        for (const std::string& component : m.components) {
          const auto [at, inserted] = byComponent_.emplace(component, modules_.size());
          if (!inserted) {
            problems_.push_back("component '" + component + "' is in both '" +
                                modules_[at->second].name + "' and '" + m.name +
                                "'; the first is used");
          }
        }
        modules_.push_back(std::move(m));
      } catch (const boost::property_tree::ptree_error& e) {
        problems_.push_back("unreadable manifest '" + path.string() + "': " + e.what());
      }
    }
  }
}

std::vector<fs::path> ModuleIndex::defaultFolders() {
  std::vector<fs::path> folders;
  if (const char* path = std::getenv("STROMA_PLUGIN_PATH")) {
    std::string_view rest = path;
    while (!rest.empty()) {
      const std::size_t end = rest.find(':');
      if (end != 0) folders.emplace_back(rest.substr(0, end));
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
    }
  }
  folders.push_back(fs::path(boost::dll::this_line_location().parent_path().string()) / "stroma");
  return folders;
}

const ModuleManifest* ModuleIndex::moduleOf(std::string_view component) const {
  const auto at = byComponent_.find(component);
  return at == byComponent_.end() ? nullptr : &modules_[at->second];
}

const ModuleManifest* ModuleIndex::module(std::string_view name) const {
  const auto at = std::ranges::find(modules_, name, &ModuleManifest::name);
  return at == modules_.end() ? nullptr : &*at;
}

std::vector<std::string> ModuleIndex::componentNames() const {
  std::vector<std::string> names;
  for (const auto& [name, index] : byComponent_) names.push_back(name);
  return names;
}

bool ModuleIndex::load(const ModuleManifest& wanted, Registry& registry, std::string& problem) {
  if (std::ranges::find(loaded_, wanted.name) != loaded_.end()) return true;
  // the manifest is checked first, so that a library of another build is never opened
  problem = mismatch(wanted.name, wanted.abi, wanted.buildId);
  if (!problem.empty()) return false;
  const PluginDescriptor* descriptor = loadPlugin(wanted.library, problem);
  if (!descriptor) return false;
  registry.setOrigin(wanted.name);
  const std::size_t conflicts = registry.conflicts().size();
  try {
    descriptor->registerComponents(registry);
  } catch (const std::exception& e) {
    problem = "plugin '" + wanted.name + "' failed to register its components: " + e.what();
    return false;
  }
  if (registry.conflicts().size() > conflicts) {
    problem = "plugin '" + wanted.name +
              "' registers a component that exists already: " + registry.conflicts().back();
    return false;
  }
  loaded_.push_back(wanted.name);
  return true;
}

}  // namespace stroma
