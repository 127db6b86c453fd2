// SPDX-License-Identifier: Apache-2.0
// Scenes that cut, through the real loader; and links asked one by one, against all facets of all
// cuts.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "components/cutting/cutting_resistance.h"
#include "components/cutting/cutting_topology_modifier.h"
#include "components/cutting/exact_predicates.h"
#include "components/mechanics/mls_mapping.h"
#include "components/mechanics/volume_constraint.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma::test {

// Which code makes the components: the modules, or what this program is linked with, so that it
// can look into them.
enum class Made { byModules, here };

class CuttingScene {
 public:
  explicit CuttingScene(const std::string& file, std::vector<std::string> overrides = {},
                        Made made = Made::byModules)
      : scene_(options(std::move(overrides), {})) {
    if (made == Made::here) registerHere();
    begin(scene_.load(std::filesystem::path(STROMA_SCENES) / file));
  }
  // A text that lies beside the cornea's scenes; it reads and writes its own files in `folder`.
  struct Text {
    std::string xml;
    std::filesystem::path folder;
  };
  explicit CuttingScene(const Text& text) : scene_(options({}, text.folder)) {
    begin(scene_.loadText(text.xml, std::filesystem::path(STROMA_SCENES) / "cornea" / "text.xml"));
  }

  Scene& operator*() { return scene_; }
  Scene* operator->() { return &scene_; }
  [[nodiscard]] TopologyModifier& modifier() { return *modifier_; }
  // Only for components made here.
  template <class T>
  [[nodiscard]] T& only() {
    const auto all = collect<T>(scene_.root());
    if (all.size() != 1) throw std::runtime_error("not the only one of its kind");
    return *all.front();
  }
  [[nodiscard]] System& system() { return *scene_.systemOf(modifier_->particles()); }
  [[nodiscard]] std::uint64_t lastStep() {
    return static_cast<std::uint64_t>(std::ceil(*scene_.root().duration / scene_.dt() - 1e-9));
  }
  void advanceTo(std::uint64_t step) {
    while (scene_.stepCount() < step) ASSERT_TRUE(scene_.step()) << scene_.divergence()->message;
  }
  void advanceTo(double time) { advanceTo(static_cast<std::uint64_t>(time / scene_.dt() + 0.5)); }

  [[nodiscard]] double value(const std::string& wanted) const {
    for (const auto& [name, value] : modifier_->lastValues())
      if (name == wanted) return value;
    ADD_FAILURE() << "the modifier tells no " << wanted;
    return 0;
  }
  [[nodiscard]] double attribute(const char* name) const {
    return modifier_->attribute(name)->number().value();
  }
  // FNV-1a over the triangles, the nodes' rest positions and how often the body has changed.
  [[nodiscard]] std::uint64_t topologyHash() const {
    const auto triangles = modifier_->surface().triangles();
    std::uint64_t hash = hashBytes(std::as_bytes(triangles));
    return hashBytes(std::as_bytes(modifier_->nodes().rest()), hash);
  }
  struct Bits {
    std::uint64_t state, topology;
    double changes;
    bool operator==(const Bits&) const = default;
  };
  [[nodiscard]] Bits bits() const {
    return {scene_.stateHash(), topologyHash(), attribute("changes")};
  }

 private:
  static SceneOptions options(std::vector<std::string> overrides,
                              const std::filesystem::path& folder) {
    SceneOptions options;
    options.pluginFolders = {STROMA_MODULES_FOLDER};
    options.overrides = std::move(overrides);
    options.writesOutput = !folder.empty();
    if (!folder.empty()) {
      options.dataFolders = {folder};
      options.outputFolder = folder;
    }
    return options;
  }
  void registerHere() {
    Registry& registry = scene_.registry();
    registry.add<MLSForceField>("MLSForceField");
    registry.add<MLSMapping>("MLSMapping");
    registry.add<VolumeConstraint>("VolumeConstraint");
    registry.add<CuttingTopologyModifier>("CuttingTopologyModifier");
    registry.add<CuttingResistance>("CuttingResistance");
  }
  void begin(bool loaded) {
    const bool good = loaded && scene_.initialise();
    EXPECT_TRUE(good) << scene_.diagnostics().text();
    if (!good) throw std::runtime_error("the scene cannot be made");
    EXPECT_EQ(scene_.diagnostics().warningCount(), 0) << scene_.diagnostics().text();
    const auto modifiers = collect<TopologyModifier>(scene_.root());
    if (!modifiers.empty()) modifier_ = modifiers.front();
  }

  Scene scene_;
  TopologyModifier* modifier_ = nullptr;
};

inline std::ostream& operator<<(std::ostream& out, const CuttingScene::Bits& bits) {
  return out << std::hex << bits.state << '/' << bits.topology << std::dec << '/' << bits.changes;
}

// Whether any of the facets lies between two points. Boxes apart from each other need no
// predicate; nothing else is skipped.
class AllFacets {
 public:
  explicit AllFacets(std::span<const RestTriangle> facets) : facets_(facets) {
    for (const RestTriangle& t : facets)
      boxes_.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])});
  }
  [[nodiscard]] bool between(const Vec3& a, const Vec3& b) const {
    const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const auto& [boxLow, boxHigh] = boxes_[k];
      if ((high.array() < boxLow.array()).any() || (low.array() > boxHigh.array()).any()) continue;
      const RestTriangle& t = facets_[k];
      if (segmentCrossesTriangle(a, b, t[0], t[1], t[2])) return true;
    }
    return false;
  }

 private:
  std::span<const RestTriangle> facets_;
  std::vector<std::pair<Vec3, Vec3>> boxes_;
};

struct LinkCount {
  long links = 0, wrong = 0, few = 0;
};

// Every row has exactly the particles that it should: none behind a cut, and all that can be seen
// within its reach. `few` counts rows with fewer than eight.
inline LinkCount checkRows(const MLSForceField& field, const AllFacets& facets) {
  const ConstVec3Span X = field.state().rest();
  const Neighbourhoods& n = field.neighbourhoods();
  LinkCount count;
  std::vector<char> own(X.size(), 0);
  for (Index i = 0; i < n.particleCount(); ++i) {
    const auto row = n.neighboursOf(i);
    if (row.size() < 8) ++count.few;
    double last = 0;
    for (const Index j : row) {
      ++count.links;
      own[static_cast<std::size_t>(j)] = 1;
      last = std::max(last, n.distance(i, X[j] - X[i]));
      if (facets.between(X[i], X[j]) || facets.between(X[j], X[i])) ++count.wrong;
    }
    const double within = n.options.count == 0 ? std::max(last, n.options.radius) : last;
    for (Index j = 0; j < n.particleCount(); ++j)
      if (j != i && !own[static_cast<std::size_t>(j)] && n.distance(i, X[j] - X[i]) < within &&
          !facets.between(X[i], X[j]))
        ++count.wrong;
    for (const Index j : row) own[static_cast<std::size_t>(j)] = 0;
  }
  return count;
}

}  // namespace stroma::test
