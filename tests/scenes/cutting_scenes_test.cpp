// SPDX-License-Identifier: Apache-2.0
// The shipped scenes that cut, to their ends: after every change all that must hold of a body that
// is cut, in the end what the scene says of itself.
#include <chrono>

#include "tests/scenes/cutting_scenes.h"

namespace stroma::test {
namespace {

struct Outcome {
  double pieces = 0, length = 0, path = 0, deviation = 0, turning = 0;
};

// Runs a scene with all checks after every change; links one by one after every fifth.
Outcome runChecked(const std::string& file, const std::string& modifier, bool subdivide) {
  const auto begin = std::chrono::steady_clock::now();
  CuttingScene run(file,
                   {modifier + ".checkEvery=1",
                    modifier + ".subdivide=" + (subdivide ? std::string("true") : "false")},
                   Made::here);
  auto& cut = run.only<CuttingTopologyModifier>();
  const auto& field = run.only<MLSForceField>();
  System& system = run.system();
  const std::vector<double> mass(system.mass().begin(), system.mass().end());
  const std::vector<Vec3> rest(system.rest().begin(), system.rest().end());

  int changes = 0;
  bool left = false;  // since the last change
  double elastic = 0;
  LinkCount asked;
  long askedFacets = 0;
  const auto ask = [&] {
    const AllFacets facets(cut.facets().facets());
    const LinkCount count = checkRows(field, facets);
    EXPECT_EQ(count.wrong, 0) << "after change " << changes;
    asked.links += count.links;
    askedFacets += static_cast<long>(cut.facets().count());
  };
  while (run->stepCount() < run.lastStep()) {
    EXPECT_TRUE(run->step());
    if (run->divergence()) {
      ADD_FAILURE() << run->divergence()->message;
      return {};
    }
    elastic = std::max(elastic, field.potentialEnergy(cut.particles().view(run->time())));
    left = left || !cut.cutting;
    if (cut.changes == changes) continue;
    left = !cut.cutting;
    EXPECT_LE(cut.changes, changes + 2) << "a step makes one change, and one that ends a cut";
    const TopologyCheck report = cut.check();
    for (const std::string& failure : report.failures)
      ADD_FAILURE() << "step " << run->stepCount() << ": " << failure;
    if (cut.changes / 5 != changes / 5) ask();
    changes = cut.changes;
    if (!report.failures.empty()) return {};
  }
  ask();

  EXPECT_GT(changes, 0);
  EXPECT_TRUE(left) << "the blade is still inside";
  EXPECT_EQ(system.size(), static_cast<Index>(rest.size()));
  EXPECT_TRUE(std::ranges::equal(system.mass(), mass)) << "to the bit";
  EXPECT_TRUE(std::ranges::equal(system.rest(), rest)) << "to the bit";
  EXPECT_EQ(run.value("invariant_failures"), 0);
  EXPECT_LT(run.value("sliver_fraction"), 0.02);
  const Outcome outcome{run.value("pieces"), run.value("incision_length"), run.value("path_length"),
                        run.value("incision_deviation"), run.value("incision_turning")};
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf(
      "%s, %s: %d changes, %.0f piece(s), incision %.3f mm of a path of %.3f mm, deviation %.4f "
      "edges, turning %.4f rad, smallest angle %.2f deg, slivers %.2f %%, free chips %.0f, energy "
      "added %+.2e J, %+.2e of the most elastic; %ld links asked of %ld facets in all; %.1f s\n",
      file.c_str(), subdivide ? "divided" : "whole elements", changes, outcome.pieces,
      1e3 * outcome.length, 1e3 * outcome.path, outcome.deviation, outcome.turning,
      run.value("smallest_angle"), 100 * run.value("sliver_fraction"), run.value("free_chips"),
      *cut.addedEnergy, elastic > 0 ? cut.addedEnergy / elastic : 0, asked.links, askedFacets,
      took.count());
  return outcome;
}

struct Case {
  const char* file;
  const char* modifier;
  int pieces;
};

class CuttingSceneRun : public testing::TestWithParam<Case> {};

TEST_P(CuttingSceneRun, isSoundAfterEveryChange) {
  const Outcome outcome = runChecked(GetParam().file, GetParam().modifier, true);
  EXPECT_EQ(outcome.pieces, GetParam().pieces);
  EXPECT_GT(outcome.length, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, CuttingSceneRun,
                         testing::Values(Case{"cornea/trephine.xml", "/cornea/cut", 2},
                                         Case{"cornea/keratome.xml", "/cornea/cut", 1},
                                         Case{"liver/cut.xml", "/liver/cut", 1},
                                         Case{"stomach/cut.xml", "/stomach/cut", 1}),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

// The cornea paper's two variants of the same cut.
TEST(CuttingSceneSmoothness, divisionMakesTheIncisionSmoothCornea) {
  const Outcome divided = runChecked("cornea/cut.xml", "/cornea/cut", true);
  EXPECT_EQ(divided.pieces, 1);
  EXPECT_NEAR(divided.length / divided.path, 1, 0.03);
  const Outcome whole = runChecked("cornea/cut.xml", "/cornea/cut", false);
  EXPECT_EQ(whole.pieces, 1);
  EXPECT_LT(2 * divided.deviation, whole.deviation);
}

TEST(CuttingSceneSmoothness, divisionMakesTheIncisionSmoothPaper) {
  const Outcome divided = runChecked("paper/cut.xml", "/cornea/cut", true);
  EXPECT_EQ(divided.pieces, 1);
  const Outcome whole = runChecked("paper/cut.xml", "/cornea/cut", false);
  EXPECT_EQ(whole.pieces, 1);
  EXPECT_LT(2 * divided.deviation, whole.deviation);
}

// A scene calls for what it names and nothing else.
TEST(CuttingSceneCalls, forTheCutWhereThereIsOne) {
  CuttingScene without("cornea/pull.xml");
  EXPECT_TRUE(without->schedule().stage(Stage::Topology).empty());
  EXPECT_EQ(std::ranges::count(without->modules().loaded(), "cutting"), 0);
  CuttingScene with("cornea/cut.xml");
  ASSERT_EQ(with->schedule().stage(Stage::Topology).size(), 1u);
  EXPECT_EQ(with->schedule().stage(Stage::Topology).front().component, &with.modifier());
  EXPECT_NE(with->schedule().text().find("cut along the blades"), std::string::npos);
  EXPECT_EQ(std::ranges::count(with->modules().loaded(), "cutting"), 1);
}

}  // namespace
}  // namespace stroma::test
