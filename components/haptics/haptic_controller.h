// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "components/haptics/haptic_loop.h"
#include "components/haptics/replay_device.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/tool.h"
#include "core/schedule.h"

namespace stroma {

// Joins a device and a tool: moves the tool with the stylus, and gives the hand the force of the
// tissue. haptic_kernel.h says how a tick is made.
//
// In batch the ticks are calls at haptic rate at the beginning of a step, in simulated time, and
// everything is deterministic. In real time (SceneOptions::realTime) a thread of its own makes them
// by the wall clock; it and the simulation exchange values and never wait for each other. Either
// way the simulation takes the newest pose in Stage::Input and publishes the contacts, and the
// other forces on the tool, in Stage::Publish.
//
// Stable range, with K_p = couplingStiffness forceScale positionScale and likewise B_p, as they are
// felt at the device, and T the period of a tick: K_p T / 2 + B_p <= 1 N s/m, half the damping of
// the calmest human grip (Colgate and Schenkel 1997 ask for K T / 2 + |B| less than it). Beyond it
// a warning is given, and the passivity controller is what is left.
class HapticController final : public Observer {
 public:
  static constexpr double stableDamping = 1;  // N s/m

  Attribute<double> couplingStiffness{
      this,
      "couplingStiffness",
      500.0,
      "Spring between stylus and tool, in the scene. Some times the stiffness of what is touched; "
      "see the stable range.",
      {.unit = "N/m", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> couplingDamping{this,
                                    "couplingDamping",
                                    0.2,
                                    "Damper beside that spring, in the scene.",
                                    {.unit = "N s/m", .min = 0, .runtime = true}};
  Attribute<double> maxForce{this,
                             "maxForce",
                             3.0,
                             "Most force that the device is given.",
                             {.unit = "N", .min = 0, .runtime = true}};
  Attribute<double> maxForceRate{this,
                                 "maxForceRate",
                                 500.0,
                                 "Most change of that force in time. Faults are exempt: they give "
                                 "zero at once.",
                                 {.unit = "N/s", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> forceScale{this,
                               "forceScale",
                               1.0,
                               "Force at the device over force in the scene. Many forces on eyes "
                               "are below a device's friction.",
                               {.min = 0, .max = 1000, .runtime = true}};
  Attribute<double> positionScale{this,
                                  "positionScale",
                                  1.0,
                                  "Distance in the scene over distance at the device.",
                                  {.min = 1e-4, .max = 1e4}};
  Attribute<Vec3> origin{
      this, "origin", Vec3::Zero(), "Where the device's origin lies in the scene.", {.unit = "m"}};
  Attribute<Quat> orientation{this, "orientation", Quat::Identity(),
                              "Rotation from the device's frame to the scene's."};
  Attribute<double> staleAfter{this,
                               "staleAfter",
                               0.1,
                               "Silence of the simulation or of the device after which the force "
                               "fades out.",
                               {.unit = "s", .min = 1e-3, .max = 10, .runtime = true}};
  Attribute<double> decayTime{this,
                              "decayTime",
                              0.05,
                              "Time in which a force then fades to nothing.",
                              {.unit = "s", .min = 1e-3, .max = 10, .runtime = true}};
  Attribute<double> recoveryTime{
      this,
      "recoveryTime",
      0.2,
      "Time in which the force comes back, at the start, after a silence "
      "and after a fault.",
      {.unit = "s", .min = 1e-3, .max = 10, .runtime = true}};
  Attribute<double> maxSpeed{this,
                             "maxSpeed",
                             10.0,
                             "A stylus that moves faster is a fault of the device.",
                             {.unit = "m/s", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> energyReserve{
      this,
      "energyReserve",
      5e-4,
      "From zero to minus this energy the passivity controller fades out what helps the hand move; "
      "the bound of the energy is minus twice as much.",
      {.unit = "J", .min = 0, .exclusiveMin = true, .runtime = true}};
  Attribute<double> passivityDamping{this,
                                     "passivityDamping",
                                     1.0,
                                     "Most damping that the passivity controller adds.",
                                     {.unit = "N s/m", .min = 0, .runtime = true}};
  Attribute<int> threadPriority{
      this,
      "threadPriority",
      20,
      "In real time: 1 to 99 = the system's real-time class, where the user is entitled to it; 0 = "
      "the ordinary one.",
      {.min = 0, .max = 99}};
  Attribute<FilePath> record{this,
                             "record",
                             {},
                             "File below the output folder for the session, which a ReplayDevice "
                             "plays; none if not given."};

  Attribute<Vec3> force{
      this, "force", Vec3::Zero(), "Force given to the device.", {.unit = "N", .output = true}};
  Attribute<Vec3> stylusPosition{this,
                                 "stylusPosition",
                                 Vec3::Zero(),
                                 "Of the stylus, in the device's frame.",
                                 {.unit = "m", .output = true}};
  Attribute<double> energy{this,
                           "energy",
                           0.0,
                           "Work of the hand that it has not got back.",
                           {.unit = "J", .output = true}};
  Attribute<double> leastEnergy{
      this, "leastEnergy", 0.0, "Least energy so far.", {.unit = "J", .output = true}};
  Attribute<double> modelAge{this,
                             "modelAge",
                             0.0,
                             "Age of the contacts in the last tick.",
                             {.unit = "s", .output = true}};
  Attribute<int> faults{
      this, "faults", 0, "Ticks with a pose or contacts that cannot be.", {.output = true}};
  Attribute<bool> faulty{
      this, "faulty", false, "From a fault until the force is back in full.", {.output = true}};
  Attribute<double> rate{
      this, "rate", 0.0, "Ticks a second, in real time.", {.unit = "Hz", .output = true}};
  Attribute<double> periodP50{
      this, "periodP50", 0.0, "Median of the periods.", {.unit = "s", .output = true}};
  Attribute<double> periodP99{
      this, "periodP99", 0.0, "99 % of the periods are not longer.", {.unit = "s", .output = true}};
  Attribute<double> periodMax{
      this, "periodMax", 0.0, "Longest period.", {.unit = "s", .output = true}};
  Attribute<int> missedDeadlines{this,
                                 "missedDeadlines",
                                 0,
                                 "Ticks that began over 1 ms late, or not at all.",
                                 {.output = true}};
  Attribute<double> missRate{
      this, "missRate", 0.0, "Their part of all that were due.", {.output = true}};
  Attribute<double> tickCpuP99{this,
                               "tickCpuP99",
                               0.0,
                               "99 % of the ticks take no more CPU time.",
                               {.unit = "s", .output = true}};

  Link<HapticDevice> device{this, "device", "Whose hand.", Lookup::nearest};
  Link<Tool> tool{this, "tool", "What the hand holds.", Lookup::nearest};

  Limiter clamped{this, "maxForce", "Ticks whose force was cut to maxForce."};
  Limiter slewed{this, "maxForceRate", "Ticks whose force could not follow."};
  Limiter restrained{this, "passivity", "Ticks in which the passivity controller acted."};
  Limiter silent{this, "staleAfter", "Ticks without a fresh model or sample."};
  Limiter faultLimiter{this, "faults", "Ticks that gave zero force for a fault."};

  void bind() override;
  void start() override;
  void reset() override;
  void stop() override;
  void schedule(Schedule& schedule) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] std::vector<std::pair<std::string, double>> lastValues() const override;
  [[nodiscard]] std::vector<std::filesystem::path> files() const override;
  [[nodiscard]] std::string trouble() const override { return trouble_; }

  // Statistics of the thread, in real time.
  [[nodiscard]] PaceStatistics pace() const { return loop_.pace(); }
  [[nodiscard]] const DurationHistogram& cpuPerTick() const { return loop_.cpuPerTick(); }

 private:
  void tick(const StepContext&) { loop_.tick(); }
  void moveTool(const StepContext& step);
  void publish(const StepContext& step);
  void showPace(const StepContext& step);

  [[nodiscard]] HapticParameters parameters() const;
  // What the tool does in this step, from the haptic side or from a recording.
  [[nodiscard]] std::optional<SessionFrame> frame(std::uint64_t step);
  void fillPlanes();
  void showState();  // as attributes and counts

  [[nodiscard]] std::filesystem::path sessionFile() const;
  void recordFrame(const SessionFrame& frame);
  void openSession();

  HapticLoop loop_;
  const ReplayDevice* replay_ = nullptr;
  HapticReport report_;          // the newest one
  HapticState counted_;          // what the limiters have counted already
  LocalContactModel model_;      // the newest one published
  std::uint32_t toolEpoch_ = 0;  // of the pose that the tool has
  std::ofstream session_;
  std::optional<std::uint64_t> resumedAt_;
  std::string trouble_;
};

}  // namespace stroma
