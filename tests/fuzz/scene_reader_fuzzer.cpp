// SPDX-License-Identifier: Apache-2.0
// Any text is either a scene that can be initialised and stepped once, or a list of errors. All
// modules of the build are there. Scenes that ask for much are read, but not initialised.
#include <cctype>
#include <cstdint>
#include <cstdlib>

#include "core/scene.h"
#include "core/traverse.h"

namespace {
using namespace stroma;

// Five digits in a row can ask for a list of many millions of indices, which is no mistake.
bool hasLongNumber(std::string_view text) {
  int digits = 0;
  for (const unsigned char c : text) {
    digits = std::isdigit(c) ? digits + 1 : 0;
    if (digits > 4) return true;
  }
  return false;
}

bool isSmall(Scene& scene) {
  constexpr int mostCount = 200;
  bool small = true;
  forEachComponent(scene.root(), [&](Component& component) {
    for (const AttributeBase* attribute : component.attributes()) {
      if (const auto* count = dynamic_cast<const Attribute<int>*>(attribute)) {
        small = small && (!count->isSet() || *count <= mostCount);
      }
      if (const auto* grid = dynamic_cast<const Attribute<std::array<Index, 3>>*>(attribute)) {
        double cells = 1;
        for (const Index n : **grid) cells *= n;
        small = small && cells <= mostCount;
      }
    }
  });
  return small;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  if (hasLongNumber(text)) return 0;
  SceneOptions options;
  options.writesOutput = false;
  Scene scene(options);
  const bool loaded = scene.loadText(std::move(text), "fuzzed.xml");
  if (loaded != (scene.diagnostics().errorCount() == 0)) std::abort();
  if (loaded && isSmall(scene) && scene.initialise()) (void)scene.step();
  if (scene.diagnostics().text().size() > 2'000'000) std::abort();
  (void)scene.diagnostics().json();
  return 0;
}
