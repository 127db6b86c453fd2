// SPDX-License-Identifier: Apache-2.0
// Cuts give the same bits, of state and of topology: at any thread count, resumed, reset, replayed.
#include "core/parallel.h"
#include "tests/scenes/cutting_scenes.h"

namespace stroma::test {
namespace {

namespace fs = std::filesystem;

// `amid`: s, the blade is inside; `after`: it has left; `end`: where runs are compared.
struct Case {
  const char* file;
  double amid, after, end;
};

class CuttingBits : public testing::TestWithParam<Case> {
 protected:
  ~CuttingBits() override { setThreadCount(1); }
};

TEST_P(CuttingBits, areTheSameAtOneAndTwoThreadsAndResumedAndReset) {
  const Case& c = GetParam();
  setThreadCount(1);
  CuttingScene straight(c.file);
  const CuttingScene::Bits whole = straight.bits();
  straight.advanceTo(c.amid);
  EXPECT_GT(straight.attribute("changes"), 0);
  EXPECT_EQ(straight.attribute("cutting"), 1);
  const Snapshot amid = straight->save();
  straight.advanceTo(c.after);
  EXPECT_EQ(straight.attribute("cutting"), 0);
  const Snapshot after = straight->save();
  straight.advanceTo(c.end);
  const CuttingScene::Bits bits = straight.bits();
  EXPECT_NE(bits.topology, whole.topology);

  setThreadCount(2);
  CuttingScene twoThreads(c.file);
  twoThreads.advanceTo(c.end);
  EXPECT_EQ(twoThreads.bits(), bits) << "two threads";
  setThreadCount(1);

  CuttingScene resumed(c.file);
  ASSERT_TRUE(resumed->restore(amid));
  resumed.advanceTo(c.end);
  EXPECT_EQ(resumed.bits(), bits) << "resumed amid the cut";
  ASSERT_TRUE(resumed->restore(after));
  resumed.advanceTo(c.end);
  EXPECT_EQ(resumed.bits(), bits) << "one that has been cut, set back to after its cut";
  CuttingScene later(c.file);
  ASSERT_TRUE(later->restore(after));
  later.advanceTo(c.end);
  EXPECT_EQ(later.bits(), bits) << "resumed after the cut";

  later->reset();
  EXPECT_EQ(later.bits(), whole);
  later.advanceTo(c.amid);
  later->reset();
  EXPECT_EQ(later.bits(), whole) << "reset amid the cut";
  later.advanceTo(c.end);
  EXPECT_EQ(later.bits(), bits) << "again after a reset";
}

INSTANTIATE_TEST_SUITE_P(Scenes, CuttingBits,
                         testing::Values(Case{"cornea/cut.xml", 0.2, 0.335, 0.34},
                                         Case{"cornea/trephine.xml", 0.12, 0.255, 0.265},
                                         Case{"paper/cut.xml", 0.13, 0.238, 0.24}),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

// A cornea without pressure under the scalpel of a hand that feels it.
std::string handText(const std::string& device, const std::string& controller) {
  return R"(<Node dt="2 ms" gravity="0 0 0">
  <MultiRateAnimationLoop hapticRate="1000"/>)" +
         device + R"(<ScalpelTool name="scalpel" length="4 mm"/>
  <HapticController device="@hand" tool="@scalpel" )" +
         controller + R"(/>
  <Node name="cornea">
    <include href="tissue.xml" pressure="0"/>
    <MeshGmshLoader name="solid" filename="../meshes/cornea_shell.msh"/>
    <BVHCollisionModel name="collision" state="@surface/nodes" topology="@surface/mesh"/>
    <PenaltyContactForceField name="contact" tools="@/scalpel" stiffness="1000 N/m"/>
    <CuttingTopologyModifier name="cut" tools="@/scalpel" solid="@solid" surfaceState="@surface/nodes"
                             topology="@surface/mesh" pierceCriterion="force" pierceForce="10 mN"/>
    <CuttingResistance name="resistance" toughness="10 J/m^2"/>
  </Node>
</Node>)";
}

struct HandRun {
  CuttingScene::Bits bits;
  bool left;
};

HandRun runHand(const std::string& device, const std::string& controller, const fs::path& folder) {
  CuttingScene run(CuttingScene::Text{handText(device, controller), folder});
  run.advanceTo(std::uint64_t{75});
  return {run.bits(), run.attribute("cutting") == 0};
}

TEST(CuttingByHand, aRecordedSessionCutsTheSameAgain) {
  const fs::path folder = fs::temp_directory_path() / "stroma-cutting-by-hand";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string hand =
      R"(<SoftwareHandDevice name="hand" mass="0.1 kg" stiffness="1000 N/m" damping="10 N s/m"
          keyTimes="0.02 0.04 0.1 0.12"
          positions="-1 0 0.3 mm  -1 0 -0.6 mm  0.5 0 -0.6 mm  0.5 0 1 mm"/>)";
  const std::string again = R"(<ReplayDevice name="hand" filename="cut.session"/>)";
  const HandRun recorded = runHand(hand, R"(record="cut.session")", folder);
  const HandRun replayed = runHand(again, "", folder);
  std::cout << "recorded " << recorded.bits << ", replayed " << replayed.bits << '\n';
  EXPECT_GT(recorded.bits.changes, 2);
  EXPECT_TRUE(recorded.left);
  EXPECT_EQ(replayed.bits, recorded.bits);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace stroma::test
