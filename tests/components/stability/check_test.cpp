// SPDX-License-Identifier: Apache-2.0
// Scenes whose figures are known exactly, with bounds on both sides of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/interfaces/observer.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

struct Made {
  explicit Made(const std::string& check,
                const std::string& solver = "<EulerExplicitSolver substeps='1'/>", int steps = 100,
                const std::string& more = "") {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    scene = std::make_unique<Scene>(std::move(options));
    ready = scene->loadText(
                "<Node name='root' dt='10 ms' gravity='0 -10 0'><Node name='body'>" + solver +
                    "<MechanicalObject name='state' position='0 0 0  2 0 0'/><UniformMass "
                    "vertexMass='1'/>" +
                    more + "</Node><Node name='criteria'><StabilityCheck name='check' " + check +
                    "/></Node></Node>",
                "scene.xml") &&
            scene->initialise();
    for (int k = 0; ready && k < steps; ++k) {
      if (!scene->step()) break;
    }
    if (ready) scene->stop();
  }
  [[nodiscard]] std::vector<CheckResult> results() const {
    std::vector<CheckResult> all;
    for (Observer* observer : collect<Observer>(scene->root())) {
      for (CheckResult& r : observer->checks()) all.push_back(std::move(r));
    }
    return all;
  }
  [[nodiscard]] CheckResult only() const {
    const auto all = results();
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? CheckResult{} : all.front();
  }
  std::unique_ptr<Scene> scene;
  bool ready = false;
};

TEST(StabilityCheck, speedOfAFreeFall) {
  const CheckResult met = Made("maxSpeed='10.001'").only();
  EXPECT_TRUE(met.passed);
  EXPECT_NEAR(met.measured, 10, 1e-12);
  EXPECT_EQ(met.step, 100u);
  EXPECT_FALSE(Made("maxSpeed='9.999'").only().passed);
}

TEST(StabilityCheck, displacementIsMeasuredByTheBody) {
  // symplectic Euler falls by g t (t + h) / 2 = 5.05, the body is 2 long
  const CheckResult result = Made("maxDisplacement='1'").only();
  EXPECT_FALSE(result.passed);
  EXPECT_NEAR(result.measured, 5.05 / 2, 1e-12);
  EXPECT_NEAR(Made("maxDisplacement='1' size='5 m'").only().measured, 1.01, 1e-12);
  EXPECT_NEAR(Made("maxShapeError='1e-9'").only().measured, 0, 1e-12);
}

TEST(StabilityCheck, theMessageNamesBoundMeasureStepAndPlace) {
  const CheckResult result = Made("maxSpeed='5 m/s'").only();
  EXPECT_EQ(result.criterion, "maxSpeed");
  EXPECT_EQ(result.message, "10 m/s at step 100 (1 s); bound at most 5 m/s");
  EXPECT_EQ(result.where.text().substr(0, 12), "scene.xml:1:");
}

TEST(StabilityCheck, referenceOfAFreeFall) {
  const std::string indices = " indices='0 1' ";
  EXPECT_TRUE(Made("reference='0 -5.05 0' referenceTolerance='1e-12'" + indices).only().passed);
  EXPECT_FALSE(Made("reference='0 -5.00 0' referenceTolerance='1e-3'" + indices).only().passed);
}

TEST(StabilityCheck, timeThatIsNotReached) {
  EXPECT_TRUE(Made("finalTime='1 s'").only().passed);
  const CheckResult result = Made("finalTime='2 s'").only();
  EXPECT_FALSE(result.passed);
  EXPECT_NEAR(result.measured, 1, 1e-12);
}

const std::string springs =
    "<RestShapeSpringsForceField name='spring' all='true' stiffness='100'/>";

TEST(StabilityCheck, energyOfImplicitEulerNeverRises) {
  const std::string solver = "<EulerImplicitSolver/><CGLinearSolver tolerance='1e-12'/>";
  const CheckResult result = Made("energyRise='1e-12'", solver, 300, springs).only();
  EXPECT_TRUE(result.passed) << result.message;
}

TEST(StabilityCheck, energyOfExplicitEulerOscillatesOrGrows) {
  // symplectic: bounded, of the order of h w / 2 = 0.05; not symplectic: it grows without end
  const CheckResult good =
      Made("energyDrift='0.2'", "<EulerExplicitSolver substeps='1'/>", 300, springs).only();
  EXPECT_TRUE(good.passed) << good.message;
  EXPECT_GT(good.measured, 0.01);
  const CheckResult bad =
      Made("energyGrowth='0.2'", "<EulerExplicitSolver substeps='1' symplectic='false'/>", 300,
           springs)
          .only();
  EXPECT_FALSE(bad.passed) << bad.message;
}

TEST(StabilityCheck, momentumUnderGravityDrifts) {
  EXPECT_FALSE(Made("momentumDrift='1e-9'").only().passed);
  const CheckResult spring = Made("momentumDrift='1e-9' angularMomentumDrift='1e-9'",
                                  "<EulerExplicitSolver substeps='1'/>", 10,
                                  "<ConstantForceField indices='0 1' forces='0 10 0'/>")
                                 .results()
                                 .at(0);
  EXPECT_TRUE(spring.passed) << spring.message;
}

TEST(StabilityCheck, criteriaOfTheEndHoldFromSettledOn) {
  const CheckResult result = Made("finalSpeed='1' settled='0.5 s'").only();
  EXPECT_FALSE(result.passed);
  EXPECT_NEAR(result.measured, 10, 1e-12);
  EXPECT_NEAR(Made("finalSpeed='1'", "<EulerExplicitSolver substeps='1'/>", 1).only().measured, 0.1,
              1e-12);
}

TEST(StabilityCheck, whatWasNeverLookedAtIsMissed) {
  const CheckResult result = Made("maxSpeed='1e9' from='1 h'").only();
  EXPECT_FALSE(result.passed);
  EXPECT_NE(result.message.find("'from'"), std::string::npos) << result.message;
}

TEST(StabilityCheck, valuesOfOtherComponents) {
  EXPECT_TRUE(Made("value='@/body/mover.currentSubsteps' maxValue='1' minValue='1'",
                   "<EulerExplicitSolver name='mover' substeps='1'/>", 3, springs)
                  .results()
                  .at(0)
                  .passed);
}

TEST(StabilityCheck, aResumedRunRemembersTheWorst) {
  const std::string check = "maxSpeed='100' energyRise='1e-9' momentumDrift='1'";
  const std::string solver = "<EulerExplicitSolver substeps='1'/>";
  const Made whole(check, solver, 80, springs);
  // that one has ended: those below go on from a snapshot
  const auto fresh = [&] {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    auto scene = std::make_unique<Scene>(std::move(options));
    EXPECT_TRUE(scene->loadText(
                    "<Node name='root' dt='10 ms' gravity='0 -10 0'><Node name='body'>" + solver +
                        "<MechanicalObject name='state' position='0 0 0  2 0 0'/><UniformMass "
                        "vertexMass='1'/>" +
                        springs + "</Node><Node name='criteria'><StabilityCheck name='check' " +
                        check + "/></Node></Node>",
                    "scene.xml") &&
                scene->initialise());
    return scene;
  };
  const auto a = fresh(), b = fresh();
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(a->step());
  ASSERT_TRUE(b->restore(a->save()));
  for (int k = 0; k < 30; ++k) ASSERT_TRUE(b->step());
  b->stop();
  std::vector<CheckResult> resumed;
  for (Observer* observer : collect<Observer>(b->root())) {
    for (CheckResult& r : observer->checks()) resumed.push_back(std::move(r));
  }
  const auto expected = whole.results();
  ASSERT_EQ(resumed.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(resumed[i].message, expected[i].message);
    EXPECT_EQ(resumed[i].measured, expected[i].measured);
  }
}

TEST(StabilityCheck, whatIsMissingIsReported) {
  for (const std::string check :
       {"", "finalPattern='1'", "referenceTolerance='0.1'", "maxValue='3'", "minVolumeRatio='1'",
        "finalInverted='0'", "maxValue='3' value='7'", "maxValue='3' value='@/body/state.position'",
        "referenceTolerance='1' reference='1 0 0' indices='7'"}) {
    const Made run(check);
    EXPECT_FALSE(run.ready) << check;
    EXPECT_GE(run.scene->diagnostics().errorCount(), 1) << check;
  }
}

TEST(StabilityCheck, withoutItAScheduleIsAsBefore) {
  Made run("maxSpeed='1'");
  const std::string schedule = run.scene->schedule().text();
  EXPECT_EQ(std::ranges::count(schedule, '\n'), 4)
      << schedule;  // head, integrate, two of the check
}

}  // namespace
}  // namespace stroma
