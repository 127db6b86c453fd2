// SPDX-License-Identifier: Apache-2.0
#include "tools/study/content_hash.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/scene_text.h"
#include "core/snapshot.h"
#include "core/traverse.h"
#include "tools/study/job.h"

namespace stroma::study {
namespace fs = std::filesystem;
namespace {

// Raised when results of older versions of the measuring itself shall not be used any more.
constexpr std::uint64_t measuringVersion = 2;

// A file's hash; files do not change while a study is planned.
std::uint64_t hashOfFile(const fs::path& file) {
  static std::map<fs::path, std::uint64_t> known;
  auto [entry, isNew] = known.try_emplace(file);
  if (isNew) entry->second = hashText(readFile(file).value_or(""), 0);
  return entry->second;
}

fs::path coreLibrary() {
  Dl_info info{};
  return dladdr(coreBuildId().data(), &info) != 0 ? info.dli_fname : "";
}

}  // namespace

std::uint64_t hashText(std::string_view text, std::uint64_t seed) {
  return hashBytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

std::string hexText(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::uint64_t hashOfInputs(Scene& scene, const fs::path& file) {
  std::uint64_t hash = hashText(hexText(hashOfFile(coreLibrary())), measuringVersion);
  const auto add = [&](const fs::path& path) { hash = hashText(hexText(hashOfFile(path)), hash); };
  std::vector<std::string> loaded = scene.modules().loaded();
  std::ranges::sort(loaded);
  for (const std::string& name : loaded) {
    for (const ModuleManifest& module : scene.modules().modules()) {
      if (module.name == name) add(module.library);
    }
  }
  forEachComponent(scene.root(), [&](Component& component) {
    for (const AttributeBase* attribute : component.attributes()) {
      const auto* path = dynamic_cast<const Attribute<FilePath>*>(attribute);
      if (!path || path->value().path.empty()) continue;
      std::string searched;
      const auto found =
          findFile(path->value().path, file.parent_path(), scene.options().dataFolders, searched);
      if (found) add(*found);
    }
  });
  return hash;
}

}  // namespace stroma::study
