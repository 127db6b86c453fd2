// SPDX-License-Identifier: Apache-2.0
// The haptic tick as a function: the coupling's balance, and every guard.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "components/haptics/haptic_kernel.h"

namespace stroma {
namespace {

constexpr double tick = 1e-3;

// A stylus over one plane z = 0, at the end of the fading in unless said otherwise.
class Kernel : public testing::Test {
 protected:
  Kernel() {
    model_.sequence = 1;
    model_.planeCount = 1;
    model_.planes[0].stiffness = 300;
    parameters().maxSpeed = 10;
    parameters().energyReserve = 1e9;  // the passivity controller has tests of its own
  }
  HapticParameters& parameters() { return model_.parameters; }
  // A tick with a fresh model and the stylus at x, at rest.
  HapticOutput at(const Vec3& x, const Vec3& v = Vec3::Zero()) {
    model_.time = sample_.time + tick;
    return withOldModel(x, v);
  }
  HapticOutput withOldModel(const Vec3& x, const Vec3& v = Vec3::Zero()) {
    sample_.time += tick;
    ++sample_.sequence;
    sample_.pose.position = x;
    sample_.linearVelocity = v;
    return HapticKernel::step(sample_, model_, tick, state_);
  }
  HapticOutput settle(const Vec3& x, int ticks = 1000) {
    HapticOutput output{};
    for (int i = 0; i < ticks; ++i) output = at(x);
    return output;
  }
  ToolSample sample_;
  LocalContactModel model_;
  HapticState state_;
};

TEST_F(Kernel, givesNothingInFreeSpace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-1e-3, 1e-3);
  Vec3 x(0, 0, 0.1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 moved(step(random), step(random), step(random));
    x += moved;
    EXPECT_EQ(at(x, moved / tick).force.norm(), 0);
  }
}

TEST_F(Kernel, theProxyRestsWhereCouplingAndTissueBalance) {
  // springs in series: K k / (K + k) times the depth of the stylus
  const HapticOutput output = settle(Vec3(0.01, 0.02, -0.002));
  const double expected = 500.0 * 300 / 800 * 0.002;
  EXPECT_LT((output.force - Vec3(0, 0, expected)).norm(), 1e-9);
  EXPECT_LT((output.proxy.position - Vec3(0.01, 0.02, -expected / 300)).norm(), 1e-9);
}

TEST_F(Kernel, aRigidPlaneHoldsTheProxyOut) {
  model_.planes[0].stiffness = 0;
  const HapticOutput output = settle(Vec3(0, 0, -0.002));
  EXPECT_NEAR(output.force.z(), 1.0, 1e-3);
  EXPECT_NEAR(output.proxy.position.z(), 0, 1e-6);
}

TEST_F(Kernel, aCornerAndManyEqualPlanesAreHeldExactly) {
  for (int i = 0; i < maxContactPlanes; ++i) {
    ContactPlane& plane = model_.planes[static_cast<std::size_t>(i)];
    plane.normal = i % 2 == 0 ? Vec3(0, 0, 1) : Vec3(std::sqrt(0.5), 0, std::sqrt(0.5));
    plane.stiffness = 1e4;
  }
  model_.planeCount = maxContactPlanes;
  const Vec3 x(-0.004, 0, -0.002);
  const HapticOutput output = settle(x);
  // the balance at the head of the header, with the forces counted anew
  Vec3 balance = 500 * (x - output.proxy.position);
  for (const ContactPlane& plane : model_.planes) {
    balance += 1e4 * std::max(0.0, -plane.normal.dot(output.proxy.position)) * plane.normal;
  }
  EXPECT_LT(balance.norm(), 1e-9);
}

TEST_F(Kernel, theTouchingPointTurnsWithTheTool) {
  model_.planes[0].arm = Vec3(0.01, 0, 0);  // a tip, a centimetre ahead
  sample_.pose.orientation = Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitY()));  // points down
  const HapticOutput output = settle(Vec3(0, 0, 0.008));
  EXPECT_NEAR(output.force.z(), 500.0 * 300 / 800 * 0.002, 1e-9);
}

TEST_F(Kernel, scalesAndTurnsBetweenDeviceAndScene) {
  parameters().positionScale = 0.1;
  parameters().forceScale = 3;
  parameters().origin = Vec3(0, 0, 0.001);
  parameters().orientation = Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitX()));
  // the device's y is the scene's z
  const HapticOutput output = settle(Vec3(0, -0.03, 0));
  EXPECT_NEAR(output.proxy.position.z(), 0.001 - 0.003 + 0.002 * 300 / 800, 1e-9);
  EXPECT_LT((output.force - Vec3(0, 3 * 500.0 * 300 / 800 * 0.002, 0)).norm(), 1e-9);
}

TEST_F(Kernel, isAFunctionOfItsArguments) {
  settle(Vec3(0, 0, -0.001), 50);
  HapticState a = state_, b = state_;
  sample_.pose.position.z() = -0.0012;
  const HapticOutput first = HapticKernel::step(sample_, model_, tick, a);
  const HapticOutput second = HapticKernel::step(sample_, model_, tick, b);
  EXPECT_EQ(first.force, second.force);
  EXPECT_EQ(first.proxy.position, second.proxy.position);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.gain, b.gain);
}

TEST_F(Kernel, forceAndSlewStayWithinTheirLimits) {
  // +-8 mm in and out at 500 Hz, the worst that passes as motion, for two seconds
  Vec3 last = Vec3::Zero();
  double largest = 0, steepest = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 f = at(Vec3(0, 0, i % 2 == 0 ? -0.008 : 0.0)).force;
    largest = std::max(largest, f.norm());
    steepest = std::max(steepest, (f - last).norm());
    last = f;
  }
  std::printf("most force %.3f N, most change %.3f N a tick\n", largest, steepest);
  EXPECT_LE(largest, 3.0 * (1 + 1e-12));
  EXPECT_LE(steepest, 0.5 * (1 + 1e-9));
  EXPECT_GT(state_.slewedTicks, 0u);
  const Vec3 pressed = settle(Vec3(0, 0, -0.009)).force;
  EXPECT_NEAR(pressed.norm(), 500.0 * 300 / 800 * 0.009, 1e-9);
  parameters().maxForce = 1;
  EXPECT_NEAR(settle(Vec3(0, 0, -0.009)).force.norm(), 1, 1e-12);
  EXPECT_GT(state_.clampedTicks, 0u);
}

// Every number of a sample in turn, with every number that is none.
TEST_F(Kernel, aPoseThatIsNoneGivesZeroForceAndAFlagAndTheForceComesBackSlowly) {
  const Vec3 inside(0, 0, -0.004);
  const double full = settle(inside).force.z();
  ASSERT_GT(full, 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (int field = 0; field < 13; ++field) {
    for (const double bad : {nan, infinite, -infinite, 1e300}) {
      ToolSample broken = sample_;
      double* numbers[] = {broken.pose.position.data(), broken.pose.orientation.coeffs().data(),
                           broken.linearVelocity.data(), broken.angularVelocity.data()};
      const int group = field < 3 ? 0 : field < 7 ? 1 : field < 10 ? 2 : 3;
      const int first[] = {0, 3, 7, 10};
      numbers[group][field - first[group]] = bad;
      // an angular velocity that is only large does no harm: it is not used
      if (group == 3 && std::isfinite(bad)) continue;
      const std::uint64_t before = state_.faults;
      const HapticOutput output = HapticKernel::step(broken, model_, tick, state_);
      EXPECT_EQ(output.force.norm(), 0) << field << " " << bad;
      EXPECT_TRUE(state_.faulty);
      EXPECT_EQ(state_.faults, before + 1);
      EXPECT_TRUE(output.proxy.position.allFinite());
      EXPECT_NEAR(output.proxy.position.z(), -full / 300, 1e-3);
      double steepest = 0, last = 0, largest = 0;
      for (int i = 0; i < 400; ++i) {
        const double f = at(inside).force.norm();
        steepest = std::max(steepest, std::abs(f - last));
        largest = std::max(largest, f);
        last = f;
      }
      ASSERT_LT(steepest, 1.05 * full * tick / 0.2) << field << " " << bad;
      ASSERT_LE(largest, full * (1 + 1e-9));
      ASSERT_NEAR(last, full, 1e-6);
      ASSERT_FALSE(state_.faulty);
    }
  }
}

TEST_F(Kernel, aJumpGivesZeroForceAndTheToolIsSetNotMoved) {
  settle(Vec3(0, 0, -0.004));
  const std::uint32_t epoch = state_.epoch;
  const HapticOutput jump = at(Vec3(1, 0, -0.004));  // 1 m in a millisecond
  EXPECT_EQ(jump.force.norm(), 0);
  EXPECT_EQ(state_.faults, 1u);
  EXPECT_TRUE(state_.faulty);
  EXPECT_LT(jump.proxy.position.x(), 1e-9);
  // it stays there: the force fades in from zero, the tool is there in another epoch
  double last = 0, steepest = 0;
  for (int i = 0; i < 300; ++i) {
    const double f = at(Vec3(1, 0, -0.004)).force.norm();
    steepest = std::max(steepest, std::abs(f - last));
    last = f;
  }
  EXPECT_LT(steepest, 1.05 * 0.75 * tick / 0.2);
  EXPECT_EQ(state_.faults, 1u);
  EXPECT_EQ(state_.epoch, epoch + 1);
  EXPECT_NEAR(state_.proxy.position.x(), 1, 1e-9);
}

TEST_F(Kernel, teleportingAllTheTimeNeverGivesForce) {
  settle(Vec3(0, 0, -0.004));
  for (int i = 0; i < 10'000; ++i) {
    // 50 mm a tick
    ASSERT_EQ(at(Vec3(i % 2 == 0 ? 0.05 : 0, 0, -0.004)).force.norm(), 0);
  }
}

TEST_F(Kernel, contactsThatAreNoneGiveZeroForce) {
  settle(Vec3(0, 0, -0.004));
  const LocalContactModel good = model_;
  const HapticState pressing = state_;
  ASSERT_GT(pressing.force.z(), 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (int field = 0; field < 6; ++field) {
    model_ = good;
    state_ = pressing;
    if (field == 0) model_.planes[0].point.z() = nan;
    if (field == 1) model_.planes[0].normal.x() = nan;
    if (field == 2) model_.planes[0].stiffness = nan;
    if (field == 3) model_.force.y() = nan;
    if (field == 4) model_.planes[0].stiffness = -300;
    if (field == 5) model_.planes[0].stiffness = infinite;
    const HapticOutput output = at(Vec3(0, 0, -0.004));
    EXPECT_TRUE(output.force.isZero(0)) << field;
    EXPECT_TRUE(output.proxy.position.allFinite()) << field;
    EXPECT_EQ(state_.faults, pressing.faults + 1) << field;
    EXPECT_TRUE(state_.faulty) << field;
  }
  model_ = good;
  state_ = pressing;
  EXPECT_GT(at(Vec3(0, 0, -0.004)).force.z(), 0.1) << "a good one is felt";
}

TEST_F(Kernel, aSilentSimulationFadesTheForceOutAndInAgain) {
  const Vec3 inside(0, 0, -0.004);
  const double full = settle(inside).force.z();
  double last = full, steepest = 0, zeroAt = 0, heldUntil = 0;
  for (int i = 1; i <= 500; ++i) {
    const double f = withOldModel(inside).force.norm();
    steepest = std::max(steepest, std::abs(f - last));
    EXPECT_LE(f, last);
    if (f == full) heldUntil = 1e-3 * i;
    if (f == 0 && zeroAt == 0) zeroAt = 1e-3 * i;
    last = f;
  }
  std::printf("%.3f N held for %.0f ms, zero at %.0f ms, most change %.1f mN a tick\n", full,
              1e3 * heldUntil, 1e3 * zeroAt, 1e3 * steepest);
  EXPECT_NEAR(heldUntil, 0.1, 0.0021);
  EXPECT_NEAR(zeroAt, 0.15, 0.0021);
  EXPECT_LE(steepest, full * tick / 0.05 * 1.001);
  double back = 0;
  for (int i = 0; i < 300; ++i) {
    const double f = at(inside).force.norm();
    back = std::max(back, std::abs(f - last));
    last = f;
  }
  std::printf("back with at most %.1f mN a tick\n", 1e3 * back);
  EXPECT_LE(back, 0.05);
  EXPECT_NEAR(last, full, 1e-9);
}

TEST_F(Kernel, aSilentDeviceFadesTheForceOut) {
  const Vec3 inside(0, 0, -0.004);
  settle(inside);
  for (int i = 0; i < 160; ++i) {
    sample_.time += tick;
    model_.time = sample_.time;
    static_cast<void>(HapticKernel::step(sample_, model_, tick, state_));
  }
  EXPECT_EQ(state_.force.norm(), 0);
}

TEST_F(Kernel, anyBitsAtAllGiveAFiniteForceWithinItsLimits) {
  std::mt19937_64 random(20261122);
  std::uint64_t faults = 0;
  for (int i = 0; i < 200'000; ++i) {
    ToolSample s = sample_;
    s.time = 1e-3 * i;
    model_.time = s.time;
    if (random() % 2 == 0) {
      // a random number of random bits somewhere
      double* numbers[] = {s.pose.position.data(), s.pose.orientation.coeffs().data(),
                           s.linearVelocity.data(), model_.planes[0].point.data()};
      const std::uint64_t bits = random();
      std::memcpy(numbers[random() % 4] + random() % 3, &bits, sizeof bits);
    }
    const Vec3 before = state_.force;
    const HapticOutput output = HapticKernel::step(s, model_, tick, state_);
    ASSERT_TRUE(output.force.allFinite() && output.proxy.position.allFinite());
    ASSERT_LE(output.force.norm(), 3 * (1 + 1e-12));
    ASSERT_TRUE(output.force.isZero(0) || (output.force - before).norm() <= 0.5 * (1 + 1e-12));
    model_.planes[0].point.setZero();
  }
  faults = state_.faults;
  std::printf("%llu faults of 200000 ticks\n", static_cast<unsigned long long>(faults));
  EXPECT_GT(faults, 1000u);
}

}  // namespace
}  // namespace stroma
