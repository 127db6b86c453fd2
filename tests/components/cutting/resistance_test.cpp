// SPDX-License-Identifier: Apache-2.0
// What cutting costs the hand.
#include "tests/components/cutting/cut_block.h"

namespace stroma::test {
namespace {

constexpr double speed = 0.2;  // m/s
constexpr double depth = 5e-3;

// A scalpel through the upper 5 mm of a block of stiff tissue.
BlockOptions cutWith(const std::string& resistance) {
  return {.tools = scalpel("scalpel", "0 0.09", "6.3 -3 3  6.3 15 3"),
          .cut = R"(bladePoints="81")",  // pieces of a quarter of a millimetre
          .contact = "<CuttingResistance " + resistance + "/>",
          .young = "1 MPa"};
}

TEST(Resistance, isToughnessTimesLengthAgainstTheMotion) {
  CutBlock body(cutWith(R"(toughness="20 J/m^2" restSpeed="1 mm/s")"));
  const CuttingResistance& field = *collect<CuttingResistance>(body.scene.root()).front();
  double worst = 0, reaction = 0;
  int steps = 0;
  std::vector<Vec3> f(body.cut->particles().x().size());
  while (body.scene.stepCount() < 100) {
    body.step();
    const double length = body.cut->engagedLength;
    if (length < 0.9 * depth || !body.cut->blade().advances) continue;
    ++steps;
    const Vec3 force = *field.force;
    worst = std::max(worst, (force - Vec3(0, -20 * length, 0)).norm() / (20 * length));
    EXPECT_LT((body.tool().totalForce() - force).norm(), 1e-12 * force.norm());
    std::ranges::fill(f, Vec3(Vec3::Zero()));
    const_cast<CuttingResistance&>(field).addForce(body.cut->particles().view(0), f);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& v : f) sum += v;
    reaction = std::max(reaction, (sum + force).norm() / force.norm());
  }
  std::printf("%d steps: differs from toughness L by at most %.1f %%; action + reaction %.1e\n",
              steps, 100 * worst, reaction);
  EXPECT_GT(steps, 40);
  EXPECT_LT(worst, 0.06);
  EXPECT_LT(reaction, 1e-12);
}

TEST(Resistance, workIsToughnessTimesArea) {
  CutBlock body(cutWith(R"(toughness="20 J/m^2" restSpeed="1 mm/s")"));
  const CuttingResistance& field = *collect<CuttingResistance>(body.scene.root()).front();
  body.advanceTo(0.1);
  const double area = 12e-3 * depth;
  std::printf("work %.4g J, toughness x area %.4g J\n", *field.work, 20 * area);
  EXPECT_NEAR(*field.work / (20 * area), 1, 0.05);
}

TEST(Resistance, dragGrowsWithTheSpeed) {
  CutBlock body(cutWith(R"(toughness="0" drag="10 N s/m^2")"));
  const CuttingResistance& field = *collect<CuttingResistance>(body.scene.root()).front();
  double worst = 0;
  int steps = 0;
  while (body.scene.stepCount() < 100) {
    body.step();
    const double length = body.cut->engagedLength;
    if (length < 0.9 * depth) continue;
    ++steps;
    const double wanted = 10 * length * speed;
    worst = std::max(worst, (*field.force + Vec3(0, wanted, 0)).norm() / wanted);
  }
  std::printf("%d steps: differs from drag L v by at most %.1f %%\n", steps, 100 * worst);
  EXPECT_GT(steps, 40);
  EXPECT_LT(worst, 0.06);
}

TEST(Resistance, isNoneWithoutABlade) {
  CutBlock body(cutWith(R"(toughness="20 J/m^2" drag="10 N s/m^2")"));
  const CuttingResistance& field = *collect<CuttingResistance>(body.scene.root()).front();
  body.advanceTo(0.005);
  EXPECT_EQ(*field.force, Vec3(Vec3::Zero()));
  EXPECT_EQ(*field.work, 0);
  body.advanceTo(0.1);
  EXPECT_GT(*field.work, 0);
  EXPECT_EQ(*field.force, Vec3(Vec3::Zero())) << "it has left";
}

}  // namespace
}  // namespace stroma::test
