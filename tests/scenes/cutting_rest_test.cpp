// SPDX-License-Identifier: Apache-2.0
// A cut alone moves nothing and gives no energy.
#include "tests/scenes/cutting_scenes.h"

namespace stroma::test {
namespace {

// The cornea, and a blade that cuts wherever it is. `pressure`: of the eye.
std::string blade(const std::string& pressure, const std::string& positions,
                  const std::string& keyTimes) {
  return R"(<Node dt="1 ms" gravity="0 0 0">
  <DefaultAnimationLoop/>
  <ScriptedDevice name="hand" keyTimes=")" +
         keyTimes + R"(" positions=")" + positions + R"("/>
  <ScalpelTool name="scalpel" device="@hand" length="4 mm"/>
  <Node name="cornea">
    <include href="tissue.xml" pressure=")" +
         pressure + R"("/>
    <MeshGmshLoader name="solid" filename="../meshes/cornea_shell.msh"/>
    <CuttingTopologyModifier name="cut" tools="@/scalpel" solid="@solid" surfaceState="@surface/nodes"
                             topology="@surface/mesh"/>
  </Node>
</Node>)";
}

double largest(ConstVec3Span f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, v.norm());
  return most;
}

TEST(CutAtRest, staysAtRest) {
  constexpr double unit = 0.5e6 * 0.6e-3 * 0.6e-3;     // E s^2 [N]
  for (const std::string depth : {"-0.35", "-1.5"}) {  // half the thickness, and right through
    CuttingScene run(CuttingScene::Text{
        blade("0", "-1.5 0 1 mm  -1.5 0 " + depth + " mm  1.5 0 " + depth + " mm  1.5 0 1 mm",
              "0.005 0.01 0.04 0.045"),
        {}});
    double worst = 0;
    std::vector<Vec3> f(run.system().rest().size());
    while (run->stepCount() < 60) {
      ASSERT_TRUE(run->step());
      System& system = run.system();
      worst = std::max({worst, largest(system.f())});
      system.computeForce({system.x(), system.v(), run->time()}, f);
      worst = std::max(worst, largest(f));
    }
    std::printf("depth %s mm: %.0f changes, force at rest at most %.1e E s^2\n", depth.c_str(),
                run.attribute("changes"), worst / unit);
    EXPECT_GT(run.attribute("changes"), 3);
    EXPECT_EQ(run.attribute("cutting"), 0);
    EXPECT_LE(worst, 1e-10 * unit);
  }
}

// Cut while it is strained, then left alone.
TEST(CutAndLeft, losesEnergyOnly) {
  CuttingScene run(
      CuttingScene::Text{blade("-2 kPa", "-1.5 0 1 mm  -1.5 0 -0.2 mm  1.5 0 -0.2 mm  1.5 0 2 mm",
                               "0.05 0.06 0.09 0.095"),
                         {}});
  Scene& scene = *run;
  const auto energy = [&] {
    System& system = run.system();
    return system.potentialEnergy({system.x(), system.v(), scene.time()}) +
           system.kineticEnergy(system.v());
  };
  run.advanceTo(std::uint64_t{100});
  ASSERT_GT(run.attribute("changes"), 3);
  ASSERT_EQ(run.attribute("cutting"), 0);
  const auto problem = scene.setAttribute("/cornea/surface/pressure.pressure", "0");
  ASSERT_FALSE(problem) << *problem;
  const double first = energy();
  double last = first, rise = -1e300;
  ASSERT_GT(first, 0);
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(scene.step());
    const double now = energy();
    rise = std::max(rise, (now - last) / first);
    last = now;
  }
  std::printf("energy %.3e J falls to %.3e J; greatest change in a step %+.1e of the first\n",
              first, last, rise);
  EXPECT_LE(rise, 1e-9);
  EXPECT_LT(last, 0.1 * first);
}

}  // namespace
}  // namespace stroma::test
