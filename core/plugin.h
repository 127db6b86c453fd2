// SPDX-License-Identifier: Apache-2.0
// What a module (a shared library of components) exports, and how modules are found and loaded.
//
// A module holds one PLUGIN(name, version, license, summary)(Registry& registry) {
// registry.add<...> }. Beside it lies a manifest <name>.plugin.json, written at build time, that
// lists its components, so that a module is loaded only when a scene names one of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/registry.h"

// One line that must be equal in the core and in a plugin: whatever changes the layout of shared
// types.
#ifdef __clang__
#define STROMA_COMPILER "clang"
#else
#define STROMA_COMPILER "gcc"
#endif
#if defined(__SANITIZE_ADDRESS__)
#define STROMA_SANITIZER "/asan"
#elif defined(__SANITIZE_THREAD__)
#define STROMA_SANITIZER "/tsan"
#else
#define STROMA_SANITIZER ""
#endif
#define STROMA_TEXT_(x) #x
#define STROMA_TEXT(x) STROMA_TEXT_(x)
#define STROMA_BUILD_ID \
  STROMA_COMPILER "-" STROMA_TEXT(__GNUC__) "/cxx11abi-" STROMA_TEXT(                   \
      _GLIBCXX_USE_CXX11_ABI) "/c++" STROMA_TEXT(__cplusplus) "/double/eigen-"          \
      STROMA_TEXT(EIGEN_WORLD_VERSION) "." STROMA_TEXT(EIGEN_MAJOR_VERSION) "-align"    \
      STROMA_TEXT(EIGEN_MAX_ALIGN_BYTES) STROMA_SANITIZER

namespace stroma {

inline constexpr std::uint32_t pluginMagic = 0x5354524d;  // "STRM"
// Raised when a class that plugins derive from changes.
inline constexpr std::uint16_t coreAbi = 5;

extern "C" struct PluginDescriptor {
  std::uint32_t magic;
  std::uint16_t size;  // sizeof(PluginDescriptor) when the plugin was built
  std::uint16_t abi;
  const char* name;
  const char* version;
  const char* license;
  const char* summary;
  const char* buildId;
  void (*registerComponents)(Registry&);
};

// One manifest found on the search path.
struct ModuleManifest {
  std::string name, version, license, summary, buildId;
  int abi = 0;
  std::filesystem::path library;
  std::vector<std::string> components;  // names and aliases
  // Of each component, without aliases, the interface that it implements ("ForceField"), if any.
  std::map<std::string, std::string, std::less<>> roles;
};

// The build id of this core.
[[nodiscard]] std::string_view coreBuildId();

// Loads one library and returns its descriptor, or null with the reason in `problem`. The library
// stays loaded for the life of the process: components hold code from it.
[[nodiscard]] const PluginDescriptor* loadPlugin(const std::filesystem::path& library,
                                                 std::string& problem);

// Text of the manifest for a loaded plugin: descriptor, components and their attribute names.
[[nodiscard]] std::string manifestText(const PluginDescriptor& descriptor,
                                       const std::filesystem::path& library);

class ModuleIndex {
 public:
  // Reads every manifest in the folders (no library is opened). Broken manifests are kept as
  // problems.
  explicit ModuleIndex(const std::vector<std::filesystem::path>& folders);

  // The folders searched unless told otherwise: STROMA_PLUGIN_PATH, then the folder of the
  // installed modules beside the core library.
  [[nodiscard]] static std::vector<std::filesystem::path> defaultFolders();

  [[nodiscard]] const ModuleManifest* moduleOf(std::string_view component) const;
  [[nodiscard]] const ModuleManifest* module(std::string_view name) const;
  [[nodiscard]] const std::vector<ModuleManifest>& modules() const { return modules_; }
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }
  [[nodiscard]] std::vector<std::string> componentNames() const;

  // Loads the module into the registry unless it is there already. False with the reason in
  // `problem`.
  [[nodiscard]] bool load(const ModuleManifest& module, Registry& registry, std::string& problem);
  [[nodiscard]] const std::vector<std::string>& loaded() const { return loaded_; }

 private:
  std::vector<ModuleManifest> modules_;
  std::map<std::string, std::size_t, std::less<>> byComponent_;
  std::vector<std::string> problems_, loaded_;
};

}  // namespace stroma

#define PLUGIN(name, version, license, summary)                                                    \
  static void stromaRegister_##name(::stroma::Registry&);                                          \
  extern "C"                                                                                       \
      [[gnu::visibility("default")]] const ::stroma::PluginDescriptor stroma_plugin_descriptor;    \
  const ::stroma::PluginDescriptor stroma_plugin_descriptor = {::stroma::pluginMagic,              \
                                                               sizeof(::stroma::PluginDescriptor), \
                                                               ::stroma::coreAbi,                  \
                                                               #name,                              \
                                                               version,                            \
                                                               license,                            \
                                                               summary,                            \
                                                               STROMA_BUILD_ID,                    \
                                                               stromaRegister_##name};             \
  static void stromaRegister_##name
