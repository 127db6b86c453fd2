// SPDX-License-Identifier: Apache-2.0
// What is measured of a scene, where the answer is known by hand.
#include "tools/study/measures.h"

#include <gtest/gtest.h>

namespace stroma::study {
namespace {

// Two masses of 2 kg under gravity; the first one cannot fall, the second is pushed up by 5 N.
constexpr const char* twoMasses = R"(<Node name="root" dt="0.1 s" gravity="0 0 -10">
  <EulerExplicitSolver name="solver" substeps="1"/>
  <MechanicalObject name="state" position="0 0 0  3 0 0"/>
  <UniformMass name="mass" totalMass="4 kg"/>
  <PartialFixedProjectiveConstraint name="floor" indices="0" fixedDirections="0 0 1"/>
  <FixedPlaneProjectiveConstraint name="ramp" indices="0" direction="3 0 4"/>
  <ConstantForceField name="push" indices="0 1" forces="0 0 0  0 0 5"/>
</Node>)";

class TwoMasses : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scene_.loadText(twoMasses, "two.xml") && scene_.initialise())
        << scene_.diagnostics().text();
  }
  Json measured(const Measure& measure) { return evaluate(scene_, measure); }

  static Measure of(Measure::Kind kind, const char* path = "") {
    Measure measure;
    measure.name = "measured";
    measure.kind = kind;
    measure.path = path;
    return measure;
  }
  static Measure reaction(const char* constraint, std::size_t axis) {
    Measure measure = of(Measure::Kind::reaction, constraint);
    measure.axis = axis;
    return measure;
  }
  static Measure field(std::vector<Vec3> points) {
    Measure measure = of(Measure::Kind::field, "/state");
    measure.points = std::move(points);
    return measure;
  }

  Scene scene_;
};

TEST_F(TwoMasses, aReactionIsWhatTheConstraintTakes) {
  EXPECT_DOUBLE_EQ(measured(reaction("/floor", 3))["value"], 20);
  EXPECT_DOUBLE_EQ(measured(reaction("/floor", 0))["value"], 20);
  EXPECT_EQ(measured(reaction("/floor", 1))["value"], 0);
}

TEST_F(TwoMasses, aReactionIsAlongTheHeldDirectionOnly) {
  // of 20 N downwards 16 N are along the plane's normal (0.6, 0, 0.8)
  EXPECT_NEAR(measured(reaction("/ramp", 0))["value"], 16, 1e-12);
  EXPECT_NEAR(measured(reaction("/ramp", 1))["value"], 9.6, 1e-12);
  EXPECT_NEAR(measured(reaction("/ramp", 3))["value"], 12.8, 1e-12);
}

TEST_F(TwoMasses, anEnergyCountsFromRest) {
  const Measure energy = of(Measure::Kind::energy);
  EXPECT_EQ(measured(energy)["value"], 0);
  ASSERT_TRUE(scene_.step());
  // the second one falls by 7.5 m/s^2 for one symplectic step: 0.075 m, under 15 N
  EXPECT_NEAR(measured(energy)["value"], -15 * 0.075, 1e-12);
}

TEST_F(TwoMasses, pointsOutsideTheBodyAreRefused) {
  EXPECT_TRUE(measured(field({{0, 0, 0}, {3, 0, 0}, {-2.9, 0, 0}})).contains("field"));
  const Json refused = measured(field({{1, 0, 0}, {0, 3.1, 0}}));
  ASSERT_TRUE(refused.contains("problem"));
  const std::string problem = refused["problem"];
  EXPECT_NE(problem.find("0 3.1 0"), std::string::npos) << problem;
}

}  // namespace
}  // namespace stroma::study
