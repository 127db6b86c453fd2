// SPDX-License-Identifier: Apache-2.0
#include "core/scene.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/traverse.h"
#include "test_components.h"

namespace stroma::test {
namespace {

const std::string body = R"(<SymplecticEuler name="solver"/>
  <Points name="points" position="1 0 0  0 2 0"/><UnitMass/><Tether name="tether" stiffness="4"/>)";

std::string wrapped(const std::string& inner, const std::string& attributes = "") {
  return "<Node name=\"root\" dt=\"0.01\" gravity=\"0 0 0\" " + attributes + ">\n  " + inner +
         "\n</Node>";
}

Component& component(Scene& scene, const std::string& name) {
  Component* found = nullptr;
  forEachComponent(scene.root(), [&](Component& c) {
    if (c.name() == name) found = &c;
  });
  EXPECT_NE(found, nullptr) << name;
  return *found;
}

TEST(Scene, runsAStep) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(body))) << scene->diagnostics().text();
  ASSERT_TRUE(scene->step());
  const Vec3 x = scene->systems()[0]->x()[0];
  EXPECT_DOUBLE_EQ(x.x(), 1 - 0.01 * 0.01 * 4);
  EXPECT_DOUBLE_EQ(scene->time(), 0.01);
}

TEST(Scene, elementOrderDoesNotMatter) {
  auto scene = makeScene();
  const std::string xml = wrapped(R"(<Tether name="t" state="@p"/><UnitMass/><SymplecticEuler/>
    <Points name="p" position="@c.numbers"/><Counter name="c" numbers="1 2 3"/>)");
  ASSERT_TRUE(ready(*scene, xml)) << scene->diagnostics().text();
  EXPECT_EQ(scene->particleCount(), 1);
  EXPECT_EQ(scene->systems()[0]->x()[0], Vec3(1, 2, 3));
}

TEST(Scene, reportsAllProblemsInOnePass) {
  auto scene = makeScene();
  EXPECT_FALSE(ready(*scene, wrapped(R"(<Pointz position="0 0 0"/>
  <Points name="p" positon="1 2 3"/>
  <Tether stiffness="-1"/>
  <Tether stiffness="1 kPa" state="@q"/>)")));
  EXPECT_EQ(scene->diagnostics().errorCount(), 5) << scene->diagnostics().text();
  const std::string text = scene->diagnostics().text();
  EXPECT_NE(text.find("scene.xml:2:4: error: unknown component 'Pointz'"), std::string::npos)
      << text;
  EXPECT_NE(text.find("did you mean 'position'?"), std::string::npos) << text;
  EXPECT_NE(text.find("out of range: it must be at least 0 N/m"), std::string::npos) << text;
}

TEST(Scene, columnsSurviveEntitiesBomAndLineEnds) {
  auto scene = makeScene();
  const std::string xml =
      "\xEF\xBB\xBF<!-- c &amp; -->\r\n<Node name=\"a&lt;b\">\r\n  <Points\r\n    "
      "positon=\"1\"/>\r\n</Node>";
  EXPECT_FALSE(scene->loadText(xml, "s.xml"));
  EXPECT_EQ(scene->diagnostics().all()[0].where.text(), "s.xml:4:5");
}

TEST(Scene, unitsOfBareNumbersFollowTheNode) {
  auto scene = makeScene();
  const std::string xml = R"(<Node units="mm g s" gravity="0 0 0"><SymplecticEuler/><UnitMass/>
    <Points position="1 2 3"/><Tether name="t" stiffness="5"/></Node>)";
  ASSERT_TRUE(ready(*scene, xml)) << scene->diagnostics().text();
  EXPECT_EQ(scene->systems()[0]->x()[0], Vec3(0.001, 0.002, 0.003));
  EXPECT_DOUBLE_EQ(*static_cast<Tether&>(component(*scene, "t")).stiffness, 5e-3);
}

TEST(Scene, cyclesOfLinksAreNamed) {
  auto scene = makeScene();
  EXPECT_FALSE(
      ready(*scene, wrapped(R"(<Counter name="a" other="@b"/><Counter name="b" other="@a"/>)")));
  EXPECT_NE(scene->diagnostics().text().find("/a -> /b -> /a"), std::string::npos)
      << scene->diagnostics().text();
}

TEST(Scene, dataLinksConvertThroughText) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(R"(<Counter name="a" numbers="3 4"/>
    <Counter name="b" indices="@a.numbers" />)")))
      << scene->diagnostics().text();
  EXPECT_EQ(static_cast<Counter&>(component(*scene, "b")).indices->indices,
            (std::vector<Index>{3, 4}));
}

TEST(Scene, dataLinkOfWrongTypeIsAnError) {
  auto scene = makeScene();
  EXPECT_FALSE(ready(*scene, wrapped(R"(<Counter name="a" numbers="3 4.5"/>
    <Counter name="b" indices="@a.numbers" />)")));
  EXPECT_NE(scene->diagnostics().text().find("cannot take the value of '/a.numbers'"),
            std::string::npos)
      << scene->diagnostics().text();
}

TEST(Scene, srcTakesOverWhatTheElementDoesNotWrite) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(R"(<Counter name="a" numbers="3 4"/>
    <Counter name="b" src="@a"/><Counter name="c" src="@a" numbers="7"/>)")))
      << scene->diagnostics().text();
  EXPECT_EQ(*static_cast<Counter&>(component(*scene, "b")).numbers, (std::vector<double>{3, 4}));
  EXPECT_EQ(*static_cast<Counter&>(component(*scene, "c")).numbers, (std::vector<double>{7}));
}

TEST(Scene, overridesNameTheirPlace) {
  SceneOptions options;
  options.overrides = {"/tether.stiffness=9", "/tether.stifness=1", "nonsense", "/nobody.x=1"};
  auto scene = makeScene(options);
  EXPECT_FALSE(ready(*scene, wrapped(body)));
  EXPECT_EQ(scene->diagnostics().errorCount(), 3) << scene->diagnostics().text();
  EXPECT_NE(scene->diagnostics().text().find("--set:1:9: error"), std::string::npos)
      << scene->diagnostics().text();
}

TEST(Scene, overriddenValueActs) {
  SceneOptions options;
  options.overrides = {"/tether.stiffness=9 kN/m", "/.dt=0.5 ms"};
  auto scene = makeScene(options);
  ASSERT_TRUE(ready(*scene, wrapped(body))) << scene->diagnostics().text();
  EXPECT_EQ(*static_cast<Tether&>(component(*scene, "tether")).stiffness, 9000);
  EXPECT_EQ(scene->dt(), 0.0005);
}

TEST(Scene, stateWithoutSolverIsAnError) {
  auto scene = makeScene();
  EXPECT_FALSE(ready(*scene, wrapped(R"(<Points position="0 0 0"/>)")));
  EXPECT_NE(scene->diagnostics().text().find("no solver governs this state"), std::string::npos);
}

TEST(Scene, guardNamesForceFieldParticleAndStep) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(
      *scene, wrapped(R"(<SymplecticEuler name="solver"/><Points name="points" position="1 0 0"/>
    <UnitMass/><Tether name="good"/><Tether name="bad" poison="0.0495 s"/>)")))
      << scene->diagnostics().text();
  int steps = 0;
  while (scene->step()) ++steps;
  EXPECT_EQ(steps, 5);
  ASSERT_TRUE(scene->divergence());
  EXPECT_EQ(scene->divergence()->component, "/bad");
  EXPECT_EQ(scene->divergence()->particle, "/points, particle 0");
  EXPECT_EQ(scene->divergence()->step, 6u);
  // the last good state is back
  EXPECT_TRUE(scene->systems()[0]->x()[0].allFinite());
  EXPECT_EQ(scene->stepCount(), 5u);
}

TEST(Scene, snapshotResumesWithTheSameBits) {
  auto scene = makeScene();
  const std::string xml = wrapped(body + "<Counter name=\"count\"/>");
  ASSERT_TRUE(ready(*scene, xml)) << scene->diagnostics().text();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(scene->step());
  const std::string file = testing::TempDir() + "stroma_scene_test.checkpoint";
  ASSERT_EQ(writeCheckpoint(file, scene->save(), scene->contentHash()), "");
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(scene->step());

  auto second = makeScene();
  ASSERT_TRUE(ready(*second, xml));
  Snapshot snapshot;
  ASSERT_EQ(readCheckpoint(file, snapshot, second->contentHash()), "");
  ASSERT_TRUE(second->restore(snapshot));
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(second->step());
  EXPECT_EQ(scene->stateHash(), second->stateHash());
  EXPECT_EQ(*static_cast<Counter&>(component(*second, "count")).sum, 100);
}

TEST(Scene, damagedCheckpointIsRefused) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(body)));
  const std::string file = testing::TempDir() + "stroma_damaged.checkpoint";
  ASSERT_EQ(writeCheckpoint(file, scene->save(), scene->contentHash()), "");
  Snapshot snapshot;
  EXPECT_NE(readCheckpoint(file, snapshot, scene->contentHash() + 1), "");
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(100);
  stream.put('\x7f');
  stream.close();
  EXPECT_NE(readCheckpoint(file, snapshot, scene->contentHash()), "");
  EXPECT_NE(readCheckpoint(file + ".none", snapshot, scene->contentHash()), "");
}

TEST(Scene, resetStartsAgain) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(body)));
  ASSERT_TRUE(scene->step());
  const std::uint64_t first = scene->stateHash();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(scene->step());
  scene->reset();
  EXPECT_EQ(scene->time(), 0);
  ASSERT_TRUE(scene->step());
  EXPECT_EQ(scene->stateHash(), first);
}

TEST(Scene, twoScenesLiveSideBySide) {
  auto a = makeScene(), b = makeScene();
  ASSERT_TRUE(ready(*a, wrapped(body)));
  ASSERT_TRUE(ready(*b, wrapped(body, "time=\"0\"")));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(a->step());
    if (i % 2) {
      ASSERT_TRUE(b->step());
    }
  }
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b->step());
  EXPECT_EQ(a->stateHash(), b->stateHash());
}

TEST(Scene, componentsThatDoNothingAddNoCall) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(body)));
  std::size_t calls = 0;
  for (int s = 0; s < stageCount; ++s)
    calls += scene->schedule().stage(static_cast<Stage>(s)).size();
  EXPECT_EQ(calls, 1u) << scene->schedule().text();  // the solver alone
}

TEST(Scene, runtimeAttributesChangeBetweenSteps) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped(body)));
  EXPECT_EQ(scene->setAttribute("/tether.stiffness", "0"), std::nullopt);
  EXPECT_NE(scene->setAttribute("/tether.damping", "0"), std::nullopt);
  EXPECT_NE(scene->setAttribute("/tether.stiffness", "-3"), std::nullopt);
  ASSERT_TRUE(scene->step());
  EXPECT_EQ(scene->systems()[0]->x()[0], Vec3(1, 0, 0));
}

TEST(Scene, deactivatedNodesAreLeftOut) {
  auto scene = makeScene();
  ASSERT_TRUE(ready(*scene, wrapped("<Node name=\"off\" activated=\"0\"><Nonsense/></Node>")));
  EXPECT_TRUE(scene->root().children().empty());
}

TEST(Scene, lenientModeWarns) {
  SceneOptions options;
  options.lenient = true;
  auto scene = makeScene(options);
  ASSERT_TRUE(ready(*scene, wrapped(body + "<Nonsense/><Counter colour=\"red\"/>")))
      << scene->diagnostics().text();
  EXPECT_EQ(scene->diagnostics().warningCount(), 2);
}

TEST(Scene, sofaElementsAndCommentsAreAccepted) {
  auto scene = makeScene();
  ASSERT_TRUE(
      ready(*scene, wrapped(body + R"(<RequiredPlugin pluginName="Sofa.Component.Mass SofaX"/>
    <VisualStyle displayFlags="showAll"/><Object type="Counter" name="o" _increment="zzz" NOnumbers="q"
    template="Vec3d" printLog="1" tags="a"/><Node name="n">
    <OldPoints name="old" position="0 0 0" template="Vec3d"/></Node>)")))
      << scene->diagnostics().text();
  EXPECT_TRUE(component(*scene, "o").verbose());
  EXPECT_EQ(component(*scene, "old").type(), "Points");
  auto rigid = makeScene();
  EXPECT_FALSE(ready(*rigid, wrapped(R"(<Points template="Rigid3d" position="0 0 0"/>)")));
}

TEST(Scene, visualRateRunsAtItsRate) {
  auto scene = makeScene();
  class Loop final : public AnimationLoop {
    [[nodiscard]] Rates rates() const override { return {30, 0}; }
  };
  scene->registry().add<Loop>("Loop");
  ASSERT_TRUE(ready(*scene, R"(<Node dt="0.001"><Loop/><Counter name="count"/></Node>)"))
      << scene->diagnostics().text();
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(scene->step());
  EXPECT_EQ(*static_cast<Counter&>(component(*scene, "count")).sum, 30);
}

}  // namespace
}  // namespace stroma::test
