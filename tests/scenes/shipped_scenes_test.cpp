// SPDX-License-Identifier: Apache-2.0
// The shipped scenes through the real loader: they load without a remark, do what they say, call
// for nothing else, and give the same bits at any thread count and after a resumption.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/interfaces/observer.h"
#include "core/parallel.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shippedScenes() {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(STROMA_SCENES)) {
    // what lies in studies itself are studies; their scenes are one folder deeper
    const bool isStudy = entry.path().parent_path().filename() == "studies";
    if (entry.path().extension() == ".xml" && !isStudy) {
      scenes.push_back(fs::relative(entry.path(), STROMA_SCENES).string());
    }
  }
  std::ranges::sort(scenes);
  return scenes;
}

std::unique_ptr<Scene> start(const std::string& file, std::vector<std::string> overrides = {}) {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.overrides = std::move(overrides);
  options.writesOutput = false;
  auto scene = std::make_unique<Scene>(options);
  const bool good = scene->load(fs::path(STROMA_SCENES) / file) && scene->initialise();
  EXPECT_TRUE(good) << scene->diagnostics().text();
  return scene;
}

void advance(Scene& scene, int steps) {
  for (int i = 0; i < steps; ++i) {
    ASSERT_TRUE(scene.step()) << scene.divergence()->message;
  }
}

double monitor(Scene& scene, const std::string& wanted) {
  for (const Observer* observer : collect<Observer>(scene.root())) {
    for (const auto& [name, value] : observer->lastValues()) {
      if (name == wanted) return value;
    }
  }
  ADD_FAILURE() << "no monitor " << wanted;
  return 0;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, loadsWithoutRemarkAndRuns) {
  const auto scene = start(GetParam());
  EXPECT_EQ(scene->diagnostics().warningCount(), 0) << scene->diagnostics().text();
  advance(*scene, 3);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(CorneaPull, apexFollowsTheGripAndTheRimStays) {
  for (const double scale : {1.0, -1.0}) {
    const auto scene = start("cornea/pull.xml", {"/cornea/grip.scale=" + std::to_string(scale)});
    advance(*scene, 300);
    EXPECT_GT(scale * monitor(*scene, "apex_displacement"), 50e-6) << scale;
    EXPECT_LT(monitor(*scene, "rim_displacement"), 1e-6) << scale;
  }
}

TEST(CorneaPull, callsForNothingElse) {
  const auto scene = start("cornea/pull.xml");
  const std::set<std::string> loaded(scene->modules().loaded().begin(),
                                     scene->modules().loaded().end());
  const std::set<std::string> wanted = {"animation", "boundary", "io",    "mass",    "mechanics",
                                        "sampling",  "solver",   "state", "topology"};
  EXPECT_EQ(loaded, wanted);
  EXPECT_TRUE(scene->schedule().stage(Stage::Collide).empty());
  EXPECT_TRUE(scene->schedule().stage(Stage::Topology).empty());
  EXPECT_EQ(scene->schedule().stage(Stage::Solve).size(), 1u);
}

struct RunCase {
  const char* file;
  int steps;
};

class Determinism : public testing::TestWithParam<RunCase> {};

TEST_P(Determinism, sameBitsAtOneAndTwoThreads) {
  std::uint64_t hash[2];
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    const auto scene = start(GetParam().file);
    advance(*scene, GetParam().steps);
    hash[threads - 1] = scene->stateHash();
  }
  setThreadCount(1);
  EXPECT_EQ(hash[0], hash[1]);
}

TEST_P(Determinism, resumptionHasTheSameBits) {
  const auto straight = start(GetParam().file);
  advance(*straight, GetParam().steps / 2);
  const Snapshot half = straight->save();
  advance(*straight, GetParam().steps - GetParam().steps / 2);

  const auto resumed = start(GetParam().file);
  ASSERT_TRUE(resumed->restore(half));
  advance(*resumed, GetParam().steps - GetParam().steps / 2);
  EXPECT_EQ(straight->stateHash(), resumed->stateHash());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Determinism,
                         testing::Values(RunCase{"paper/cornea.xml", 1000},
                                         RunCase{"paper/liver.xml", 200},
                                         RunCase{"cornea/pull.xml", 130},
                                         RunCase{"cornea/hand.xml", 140},
                                         RunCase{"tutorials/tools.xml", 300}),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace stroma
