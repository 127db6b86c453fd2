// SPDX-License-Identifier: Apache-2.0
// A whole scene from XML, with a real tool, contact and solver: what a hand did is recorded and
// replayed to the same bits.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/scene.h"

namespace stroma {
namespace {

namespace fs = std::filesystem;

// A ball on a sheet of points that hang on springs.
std::string sceneText(const std::string& device, const std::string& controller) {
  return R"(<Node dt="2 ms" gravity="0 0 0">
  <MultiRateAnimationLoop hapticRate="1000"/>)" +
         device + R"(<ProbeTool name="probe" radius="0.5 mm"/>
  <HapticController device="@hand" tool="@probe" )" +
         controller + R"(/>
  <Node name="sheet">
    <EulerImplicitSolver rayleighMass="50"/>
    <CGLinearSolver tolerance="1e-8" iterations="200"/>
    <MeshOBJLoader name="loader" filename="meshes/cornea_sheet.obj"/>
    <MeshTopology name="mesh" src="@loader"/>
    <MechanicalObject name="nodes"/>
    <UniformMass totalMass="0.1 g"/>
    <RestShapeSpringsForceField all="true" stiffness="5 N/m"/>
    <BVHCollisionModel name="collision"/>
    <PenaltyContactForceField tools="@/probe" stiffness="50 N/m" friction="0.2"/>
  </Node>
</Node>)";
}

struct Outcome {
  std::uint64_t hash = 0;
  double moved = 0;  // m, of the point that moved farthest
};

Outcome run(const std::string& text, const fs::path& folder) {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.dataFolders = {STROMA_SCENES, folder};
  options.outputFolder = folder;
  Scene scene(options);
  const bool good = scene.loadText(text, folder / "scene.xml") && scene.initialise();
  EXPECT_TRUE(good) << scene.diagnostics().text();
  if (!good) return {};
  const Vec3Span x = scene.systems().front()->x();
  const std::vector<Vec3> before(x.begin(), x.end());
  Outcome outcome;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(scene.step());
    for (std::size_t k = 0; k < x.size(); ++k) {
      outcome.moved = std::max(outcome.moved, (x[k] - before[k]).norm());
    }
  }
  outcome.hash = scene.stateHash();
  return outcome;
}

TEST(ReplayScene, aRecordedHandGivesTheSameState) {
  const fs::path folder = fs::temp_directory_path() / "stroma-replay-scene";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto hand = [](const std::string& depth) {
    return R"(<SoftwareHandDevice name="hand" keyTimes="0 0.08 0.12 0.16"
              positions="0 0 1 mm  0.2 0 )" +
           depth + R"( mm  0.2 0 -0.3 mm  0 0 1 mm"/>)";
  };
  const Outcome recorded = run(sceneText(hand("-0.3"), R"(record="hand.session")"), folder);
  const Outcome replayed =
      run(sceneText(R"(<ReplayDevice name="hand" filename="hand.session"/>)", ""), folder);
  const Outcome other = run(sceneText(hand("-0.301"), ""), folder);
  std::printf("moved by %.3f mm; state %016llx, replayed %016llx, another hand %016llx\n",
              1e3 * recorded.moved, static_cast<unsigned long long>(recorded.hash),
              static_cast<unsigned long long>(replayed.hash),
              static_cast<unsigned long long>(other.hash));
  EXPECT_GT(recorded.moved, 1e-4);
  EXPECT_EQ(replayed.hash, recorded.hash);
  EXPECT_EQ(replayed.moved, recorded.moved);
  EXPECT_NE(other.hash, recorded.hash);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace stroma
