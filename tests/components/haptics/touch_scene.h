// SPDX-License-Identifier: Apache-2.0
// A point-like tool over a flat tissue that gives way as one spring: the least scene in which a
// hand can press.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "components/animation/multi_rate_animation_loop.h"
#include "components/haptics/haptic_controller.h"
#include "components/haptics/software_hand_device.h"
#include "core/interfaces/tool.h"
#include "core/scene.h"

namespace stroma {

// A tool that is a point.
class PointTool final : public Tool {
 public:
  [[nodiscard]] const Pose& previousPose() const override { return previous_; }
  [[nodiscard]] const Pose& pose() const override { return pose_; }
  [[nodiscard]] const Vec3& linearVelocity() const override { return linear_; }
  [[nodiscard]] const Vec3& angularVelocity() const override { return angular_; }
  [[nodiscard]] bool active() const override { return active_; }
  [[nodiscard]] ConstVec3Span samplePoints() const override { return {&tip_, 1}; }
  [[nodiscard]] double radius() const override { return 0; }
  [[nodiscard]] ConstVec3Span edge() const override { return {}; }
  [[nodiscard]] bool cutting() const override { return false; }
  void setCutting(bool) override {}
  void setContacts(std::span<const Contact> contacts) override {
    contacts_.assign(contacts.begin(), contacts.end());
  }
  [[nodiscard]] std::span<const Contact> contacts() const override { return contacts_; }
  void addForce(const Vec3& force, const Vec3&) override { added_ += force; }
  void clearForces() override { added_.setZero(); }
  [[nodiscard]] Vec3 totalForce() const override {
    Vec3 sum = added_;
    for (const Contact& c : contacts_) sum += c.force;
    return sum;
  }
  [[nodiscard]] Vec3 totalTorque() const override { return Vec3::Zero(); }
  void moveTo(const Pose& pose, const Vec3& linear, const Vec3& angular, bool active) override {
    previous_ = pose_;
    pose_ = pose;
    linear_ = linear;
    angular_ = angular;
    active_ = active;
  }
  void setDriven(bool driven) override { driven_ = driven; }
  [[nodiscard]] bool driven() const { return driven_; }

 private:
  Pose previous_, pose_;
  Vec3 linear_ = Vec3::Zero(), angular_ = Vec3::Zero(), added_ = Vec3::Zero(), tip_ = Vec3::Zero();
  std::vector<Contact> contacts_;
  bool active_ = false, driven_ = false;
};

// The tissue z < h, one mass on a spring and a damper, met by a penalty spring; backward Euler.
// `trace` is FNV-1a over everything that the simulation saw and did.
class FlatTissue final : public Component {
 public:
  Attribute<double> stiffness{this, "stiffness", 60.0, "Of the tissue.", {.unit = "N/m"}};
  Attribute<double> contactStiffness{
      this, "contactStiffness", 300.0, "Of the penalty.", {.unit = "N/m"}};
  Attribute<double> mass{this, "mass", 1e-3, "Of the tissue that moves.", {.unit = "kg"}};
  Attribute<double> damping{this, "damping", 0.1, "Of the tissue.", {.unit = "N s/m"}};
  Attribute<double> stallAt{this, "stallAt", -1.0, "When a step hangs.", {.unit = "s"}};
  Attribute<double> stall{this, "stall", 0.0, "How long it hangs.", {.unit = "s"}};
  Attribute<double> busy{this, "busy", 0.0, "Computing in each step.", {.unit = "s"}};
  Link<Tool> tool{this, "tool", "What touches.", Lookup::nearest};

  void schedule(Schedule& schedule) override {
    schedule.add<&FlatTissue::collide>(Stage::Collide, *this, "press");
  }
  void reset() override { height = speed = 0; }
  void save(StateWriter& writer) const override {
    writer.write("height", height);
    writer.write("speed", speed);
    writer.write("trace", trace);
  }
  void restore(StateReader& reader) override {
    EXPECT_TRUE(reader.read("height", height) && reader.read("speed", speed) &&
                reader.read("trace", trace));
  }

  double height = 0, speed = 0, mostForce = 0;
  std::uint64_t trace = hashBytes({});

 private:
  void collide(const StepContext& step) {
    const auto begin = std::chrono::steady_clock::now();
    if (stall > 0 && std::abs(step.time - stallAt) < 0.5 * step.dt) {
      std::this_thread::sleep_for(std::chrono::duration<double>(stall));
    }
    const double z = tool->pose().position.z(), dt = step.dt;
    double k = stiffness, pull = -stiffness * height;
    if (z < height) {
      k += contactStiffness;
      pull += contactStiffness * (z - height);
    }
    speed = (mass * speed + dt * pull) / (mass + dt * damping + dt * dt * k);
    height += dt * speed;
    Contact contact;
    contact.depth = height - z;
    contact.point = {tool->pose().position.x(), tool->pose().position.y(), height};
    contact.stiffness = contactStiffness;
    contact.velocity = {0, 0, speed};
    contact.force = {0, 0, contactStiffness * std::max(0.0, contact.depth)};
    tool->setContacts({&contact, 1U});
    mostForce = std::max(mostForce, contact.force.z());
    remember(z, step);
    while (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < busy) {
    }
  }
  void remember(double z, const StepContext& step) {
    const std::array<double, 5> seen = {z, height, speed, tool->linearVelocity().z(), step.time};
    trace = hashBytes(std::as_bytes(std::span(seen)), trace);
    const std::array<bool, 1> trigger = {tool->active()};
    trace = hashBytes(std::as_bytes(std::span(trigger)), trace);
  }
};

struct TouchScene {
  std::unique_ptr<Scene> scene;
  HapticController* controller = nullptr;
  PointTool* tool = nullptr;
  FlatTissue* tissue = nullptr;
  std::string problems;

  void step(int count = 1) {
    for (int i = 0; i < count; ++i) EXPECT_TRUE(scene->step());
  }
};

struct TouchOptions {
  double dt = 0.01;
  std::string device =
      "<SoftwareHandDevice positions=\"0 0 0.005  0 0 -0.01\" keyTimes=\"0 0.5\" "
      "pressed=\"0.3 0.7\"/>";
  std::string controller;  // attributes
  std::string tissue;
  bool realTime = false;
  std::filesystem::path folder;  // empty: nothing is written
};

// The extra component is registered under "Extra", if given.
template <class Extra = FlatTissue>
TouchScene touchScene(const TouchOptions& with) {
  SceneOptions options;
  options.pluginFolders.clear();
  options.realTime = with.realTime;
  options.writesOutput = !with.folder.empty();
  options.outputFolder = with.folder;
  options.dataFolders = {with.folder};
  TouchScene touch;
  touch.scene = std::make_unique<Scene>(options);
  Registry& registry = touch.scene->registry();
  registry.add<MultiRateAnimationLoop>("MultiRateAnimationLoop");
  registry.add<SoftwareHandDevice>("SoftwareHandDevice");
  registry.add<ReplayDevice>("ReplayDevice");
  registry.add<HapticController>("HapticController");
  registry.add<PointTool>("PointTool");
  registry.add<FlatTissue>("FlatTissue");
  registry.add<Extra>("Extra");
  const std::string text = "<Node dt=\"" + ValueTraits<double>::print(with.dt) +
                           "\"><MultiRateAnimationLoop hapticRate=\"1000\"/>" + with.device +
                           "<PointTool/><HapticController " + with.controller + "/><FlatTissue " +
                           with.tissue + "/></Node>";
  const bool good = touch.scene->loadText(text, "touch.xml") && touch.scene->initialise();
  touch.problems = touch.scene->diagnostics().text();
  if (!good) return touch;
  for (const auto& c : touch.scene->root().components()) {
    if (auto* found = dynamic_cast<HapticController*>(c.get())) touch.controller = found;
    if (auto* found = dynamic_cast<PointTool*>(c.get())) touch.tool = found;
    if (auto* found = dynamic_cast<FlatTissue*>(c.get())) touch.tissue = found;
  }
  return touch;
}

}  // namespace stroma
