// SPDX-License-Identifier: Apache-2.0
// Every component documents itself: what it does, a shipped scene that shows it, help for each
// attribute.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/plugin.h"

namespace stroma {
namespace {

namespace fs = std::filesystem;

TEST(Reference, everyComponentIsDocumented) {
  ModuleIndex index({STROMA_MODULES_FOLDER});
  ASSERT_FALSE(index.modules().empty());
  EXPECT_TRUE(index.problems().empty());
  Registry registry;
  for (const ModuleManifest& module : index.modules()) {
    std::string problem;
    ASSERT_TRUE(index.load(module, registry, problem)) << problem;
  }
  EXPECT_TRUE(registry.conflicts().empty());
  const fs::path root = fs::path(STROMA_SCENES).parent_path();
  for (const auto& [name, entry] : registry.entries()) {
    EXPECT_FALSE(entry.doc.empty()) << name;
    EXPECT_TRUE(fs::exists(root / entry.example)) << name << ": example '" << entry.example << "'";
    const auto component = registry.create(entry);
    for (const AttributeBase* a : component->attributes()) {
      EXPECT_FALSE(a->doc().empty()) << name << "." << a->name();
      EXPECT_TRUE(a->info().unit.empty() || parseUnit(a->info().unit)) << name << "." << a->name();
      EXPECT_TRUE(a->info().output || a->info().required || a->printDefault() == a->print())
          << name << "." << a->name();
    }
    for (const LinkBase* l : component->links())
      EXPECT_FALSE(l->doc().empty()) << name << "." << l->name();
    for (const Limiter* l : component->limiters()) EXPECT_FALSE(l->doc().empty()) << name;
  }
}

TEST(Reference, examplesShowTheComponent) {
  ModuleIndex index({STROMA_MODULES_FOLDER});
  Registry registry;
  std::string problem;
  for (const ModuleManifest& module : index.modules()) (void)index.load(module, registry, problem);
  const fs::path root = fs::path(STROMA_SCENES).parent_path();
  for (const auto& [name, entry] : registry.entries()) {
    // a scene and what it includes from its own folder
    bool shown = false;
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator((root / entry.example).parent_path(), ignored)) {
      if (!file.is_regular_file()) continue;
      std::ifstream stream(file.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      shown = shown || text.find("<" + name) != std::string::npos;
    }
    EXPECT_TRUE(shown) << name << " does not occur beside " << entry.example;
  }
}

}  // namespace
}  // namespace stroma
