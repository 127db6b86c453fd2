// SPDX-License-Identifier: Apache-2.0
// Hands that press, hold and let go, over the stable range: energy and calm.
#include <gtest/gtest.h>

#include "tests/components/haptics/touch_scene.h"

namespace stroma {
namespace {

struct Outcome {
  double leastEnergy = 0;
  double early = 0, late = 0;  // peak to peak motion of the stylus in two half seconds of holding
  double mostForce = 0, stepOfForce = 0;  // N; largest change in a tick
  std::uint64_t restrained = 0;
};

// Down to 10 mm below the tissue in 0.3 s, held to 3 s, up and out.
Outcome press(double mass, double stiffness, double damping, double tissue, double contact,
              double dt, double grip = 2) {
  const auto number = [](double value) { return "\"" + ValueTraits<double>::print(value) + "\""; };
  TouchOptions options;
  options.dt = dt;
  options.device =
      "<SoftwareHandDevice positions=\"0 0 0.005  0 0 -0.01  0 0 -0.01  0 0 0.02\" "
      "keyTimes=\"0 0.3 3 3.3\" friction=\"0\" mass=" +
      number(mass) + " damping=" + number(grip) + "/>";
  options.controller =
      "couplingStiffness=" + number(stiffness) + " couplingDamping=" + number(damping);
  options.tissue = "stiffness=" + number(tissue) + " contactStiffness=" + number(contact);
  TouchScene touch = touchScene(options);
  EXPECT_TRUE(touch.controller) << touch.problems;
  Outcome outcome;
  double low[2] = {1, 1}, high[2] = {-1, -1};
  for (int i = 0; i * dt < 4; ++i) {
    touch.step();
    const double z = touch.controller->stylusPosition->z(), time = touch.scene->time();
    const int window = time > 1 && time <= 1.5 ? 0 : time > 2.5 && time <= 3 ? 1 : -1;
    if (window >= 0) {
      low[window] = std::min(low[window], z);
      high[window] = std::max(high[window], z);
    }
    outcome.mostForce = std::max(outcome.mostForce, touch.controller->force->norm());
  }
  EXPECT_EQ(touch.controller->force->norm(), 0);
  EXPECT_EQ(*touch.controller->faults, 0);
  outcome.early = high[0] - low[0];
  outcome.late = high[1] - low[1];
  outcome.leastEnergy = touch.controller->leastEnergy;
  outcome.restrained = touch.controller->restrained.count();
  return outcome;
}

// The bound that HapticController documents: minus twice its energyReserve.
constexpr double bound = -1e-3;

TEST(Passivity, pressingAndHoldingIsCalmOverTheStableRange) {
  double least = 0, worstLate = 0;
  std::uint64_t restrained = 0;
  int runs = 0;
  for (const double mass : {0.05, 0.2, 1.0}) {
    for (const double k : {50.0, 200.0, 500.0, 1000.0, 1900.0}) {
      const double most = HapticController::stableDamping - k * 1e-3 / 2;
      for (const double b : {0.0, most / 2, most}) {
        // a cornea, a stiff tissue, a nearly rigid one
        for (const auto& [tissue, contact] :
             {std::pair{60.0, 300.0}, std::pair{500.0, 1000.0}, std::pair{1e5, 1e5}}) {
          for (const double dt : {0.002, 0.01}) {
            const Outcome o = press(mass, k, b, tissue, contact, dt);
            const std::string what = std::to_string(mass) + " kg, K " + std::to_string(k) + ", B " +
                                     std::to_string(b) + ", tissue " + std::to_string(tissue) +
                                     ", dt " + std::to_string(dt);
            EXPECT_GE(o.leastEnergy, bound) << what;
            // the hand's own swing dies by exp(-1.5 s c / 2 m), to 0.22 for the heaviest
            EXPECT_LE(o.late, std::max(0.4 * o.early, 2e-6)) << what;
            EXPECT_GT(o.mostForce, 0.05) << what;
            least = std::min(least, o.leastEnergy);
            worstLate = std::max(worstLate, o.late);
            restrained += o.restrained;
            ++runs;
          }
        }
      }
    }
  }
  std::printf(
      "%d runs: least energy %.3g mJ (bound %.3g), largest swing while held %.3g mm, %llu ticks "
      "restrained\n",
      runs, 1e3 * least, 1e3 * bound, 1e3 * worstLate, static_cast<unsigned long long>(restrained));
}

TEST(Passivity, beyondTheStableRangeTheControllerHoldsTheBound) {
  // ten times the range, hands that damp little
  double least = 0;
  std::uint64_t restrained = 0;
  for (const double mass : {0.05, 0.2, 1.0}) {
    for (const double k : {4000.0, 20000.0}) {
      const Outcome o = press(mass, k, 0, 1e5, 1e5, 0.01, 0.5);
      EXPECT_GE(o.leastEnergy, bound) << mass << " kg, K " << k;
      least = std::min(least, o.leastEnergy);
      restrained += o.restrained;
    }
  }
  std::printf("least energy %.3g mJ, %llu ticks restrained\n", 1e3 * least,
              static_cast<unsigned long long>(restrained));
  EXPECT_GT(restrained, 0u) << "the controller had nothing to do: this shows nothing";
}

}  // namespace
}  // namespace stroma
