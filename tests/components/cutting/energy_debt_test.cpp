// SPDX-License-Identifier: Apache-2.0
// What a change of links has added is taken from the motion beside it, and nothing else.
#include "components/cutting/energy_debt.h"

#include <numeric>

#include "tests/components/cutting/cut_block.h"

namespace stroma::test {
namespace {

// A block whose particles move at random.
struct MovingBlock : CutBlock {
  MovingBlock() : CutBlock({.tools = scalpel("scalpel", "0 1", "0 0 1  0 0 1")}) {
    std::srand(7);
    for (Vec3& v : system().v()) v = Vec3::Random();
    system().project(system().v());
    before.assign(system().v().begin(), system().v().end());
  }
  System& system() { return *scene.systemOf(cut->particles()); }
  struct Momenta {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    double energy = 0;
  };
  Momenta momenta(ConstVec3Span v) {
    Momenta m;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double mass = system().mass()[i];
      m.linear += mass * v[i];
      m.angular += mass * system().x()[i].cross(v[i]);
      m.energy += 0.5 * mass * v[i].squaredNorm();
    }
    return m;
  }
  std::vector<Vec3> before;
};

// None of those that are held.
std::vector<Index> someParticles(Index count) {
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 50);
  return all;
}

TEST(EnergyDebt, isPaidExactlyAndKeepsTheMomenta) {
  MovingBlock body;
  const auto start = body.momenta(body.before);
  const std::vector<Index> beside = someParticles(40);
  EnergyDebt debt;
  const double energy = 0.02 * start.energy;
  debt.owe(energy, beside);
  debt.pay(body.system(), body.cut->particles());
  const auto end = body.momenta(body.system().v());
  EXPECT_EQ(debt.owed(), 0);
  EXPECT_EQ(debt.paid(), energy);
  EXPECT_NEAR(start.energy - end.energy, energy, 1e-12 * start.energy);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-13 * start.linear.norm());
  EXPECT_LT((end.angular - start.angular).norm(), 1e-12 * start.angular.norm());
  for (Index i = 0; i < body.system().size(); ++i) {
    if (i >= beside.front() && i <= beside.back()) continue;
    EXPECT_EQ(body.system().v()[i], body.before[i]);
  }
}

TEST(EnergyDebt, takesNoMoreThanTheMotionHolds) {
  MovingBlock body;
  const auto start = body.momenta(body.before);
  EnergyDebt debt;
  debt.owe(10 * start.energy, someParticles(40));
  debt.pay(body.system(), body.cut->particles());
  const auto end = body.momenta(body.system().v());
  const double paid = debt.paid();
  EXPECT_GT(paid, 0);
  EXPECT_NEAR(debt.owed() + paid, 10 * start.energy, 1e-12 * start.energy);
  EXPECT_NEAR(start.energy - end.energy, paid, 1e-12 * start.energy);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-13 * start.linear.norm());
  // what is left is one rigid motion
  debt.pay(body.system(), body.cut->particles());
  EXPECT_LT(debt.paid() - paid, 1e-20 * paid);
}

TEST(EnergyDebt, asksNothingOfWhatIsHeld) {
  MovingBlock body;
  std::vector<Index> all(static_cast<std::size_t>(body.system().size()));
  std::iota(all.begin(), all.end(), 0);
  const auto start = body.momenta(body.before);
  EnergyDebt debt;
  debt.owe(0.3 * start.energy, all);
  debt.pay(body.system(), body.cut->particles());
  const auto end = body.momenta(body.system().v());
  EXPECT_FALSE(body.system().projectors().empty());
  EXPECT_EQ(debt.owed(), 0);
  EXPECT_NEAR(start.energy - end.energy, debt.paid(), 1e-12 * start.energy);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-13 * start.linear.norm());
  for (const ParticleProjector& p : body.system().projectors())
    EXPECT_EQ(body.system().v()[p.particle], Vec3::Zero());
}

TEST(EnergyDebt, findsNothingInOneParticleAndLittleInTwo) {
  for (const Index count : {1, 2}) {
    MovingBlock body;
    const auto start = body.momenta(body.before);
    EnergyDebt debt;
    debt.owe(start.energy, someParticles(count));
    debt.pay(body.system(), body.cut->particles());
    const auto end = body.momenta(body.system().v());
    EXPECT_NEAR(start.energy - end.energy, debt.paid(), 1e-12 * start.energy);
    EXPECT_LT((end.linear - start.linear).norm(), 1e-13 * start.linear.norm());
    EXPECT_LT((end.angular - start.angular).norm(), 1e-12 * start.angular.norm());
    if (count == 1) {
      EXPECT_EQ(debt.paid(), 0);
    }
  }
}

}  // namespace
}  // namespace stroma::test
