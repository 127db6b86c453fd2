// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/rigid_motion.h"
#include "tests/components/tools/tool_scene.h"

namespace stroma::test {
namespace {

// Moves a tool, as a haptic controller does.
class Driver final : public Component {
 public:
  Link<Tool> tool{this, "tool", "What it moves.", Lookup::nearest};
  void bind() override { tool->setDriven(true); }
};

Loaded tryTools(const std::string& content, const std::filesystem::path& file = "test.xml",
                bool realTime = false) {
  SceneOptions options;
  options.pluginFolders.clear();
  options.writesOutput = false;
  options.realTime = realTime;
  Loaded loaded{std::make_unique<Scene>(options), false};
  registerAll(loaded.scene->registry());
  registerTools(loaded.scene->registry());
  loaded.scene->registry().add<Driver>("Driver");
  loaded.ready = loaded.scene->loadText(dtNode(0.001, content), file) && loaded.scene->initialise();
  return loaded;
}

Loaded loadTools(const std::string& content) {
  Loaded loaded = tryTools(content);
  EXPECT_TRUE(loaded.ready) << loaded.text();
  return loaded;
}

const std::string wavy =
    "<ScriptedDevice name='hand' keyTimes='0.01 0.03 0.04' positions='0 0 0  1 2 3 mm  1 2 0 mm' "
    "rotations='0 0 0  0 0 90  40 0 90' buttons='0 1 0'/>";

TEST(ScriptedDevice, keyPosesAreMetExactly) {
  const Loaded s = loadTools(wavy);
  auto& device = s.find<ScriptedDevice>();
  for (const KeyPose& key : device.keys()) {
    const ToolSample sample = device.read(key.time);
    EXPECT_EQ(sample.pose.position, key.pose.position);
    EXPECT_NEAR(sample.pose.orientation.angularDistance(key.pose.orientation), 0, 1e-15);
    EXPECT_EQ(sample.buttons, key.buttons);
  }
  EXPECT_EQ(device.read(-1).pose.position, Vec3(0, 0, 0));
  EXPECT_EQ(device.read(9).pose.position, Vec3(1e-3, 2e-3, 0));
  EXPECT_EQ(device.read(9).linearVelocity, Vec3::Zero());
  EXPECT_EQ(device.read(0.02).buttons, 0u);
  EXPECT_EQ(device.read(0.035).buttons, 1u);
}

TEST(ScriptedDevice, velocitiesAreTheDerivativesOfThePoses) {
  const Loaded s = loadTools(wavy);
  auto& device = s.find<ScriptedDevice>();
  double worst = 0;
  for (const double time : {0.011, 0.02, 0.0299, 0.0301, 0.039}) {
    constexpr double h = 1e-6;
    const ToolSample at = device.read(time), a = device.read(time - h), b = device.read(time + h);
    const Vec3 v = (b.pose.position - a.pose.position) / (2 * h);
    const Vec3 w = rotationVector(a.pose.orientation, b.pose.orientation) / (2 * h);
    worst = std::max({worst, (v - at.linearVelocity).norm() / at.linearVelocity.norm(),
                      (w - at.angularVelocity).norm() / at.angularVelocity.norm()});
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_NEAR(device.read(0.02).angularVelocity.z(), std::numbers::pi / 2 / 0.02, 1e-10);
  std::printf("largest relative difference of a velocity from the differenced pose: %.1e\n", worst);
}

TEST(ScriptedDevice, quaternionsAndAnglesSayTheSame) {
  const Loaded q =
      loadTools("<ScriptedDevice keyTimes='0' positions='0 0 0' orientations='0.5 0.5 0.5 0.5'/>");
  const Loaded e =
      loadTools("<ScriptedDevice keyTimes='0' positions='0 0 0' rotations='90 0 90'/>");
  const Quat a = q.find<ScriptedDevice>().read(0).pose.orientation;
  const Quat b = e.find<ScriptedDevice>().read(0).pose.orientation;
  EXPECT_NEAR(a.angularDistance(b), 0, 1e-15);
}

class TableFile {
 public:
  explicit TableFile(const std::string& content)
      : folder_(std::filesystem::temp_directory_path() /
                ("stroma-tools-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "path.csv") << content;
  }
  ~TableFile() { std::filesystem::remove_all(folder_); }
  [[nodiscard]] Loaded load() const {
    return tryTools("<ScriptedDevice filename='path.csv'/>", folder_ / "test.xml");
  }

 private:
  std::filesystem::path folder_;
};

TEST(ScriptedDevice, tableGivesTheSameAsAttributes) {
  const TableFile file(
      "# comment\n\ntime, x,y,z, qx,qy,qz,qw, buttons\n0,0,0,0,0,0,0,1,0\r\n"
      "0.5, 1e-3,0,-2e-3, 0,0,0.70710678118654752,0.70710678118654752, 3\n");
  const Loaded s = file.load();
  ASSERT_TRUE(s.ready) << s.text();
  const ToolSample half = s.find<ScriptedDevice>().read(0.25);
  EXPECT_EQ(half.pose.position, Vec3(0.5e-3, 0, -1e-3));
  EXPECT_NEAR(half.angularVelocity.z(), std::numbers::pi, 1e-12);
  EXPECT_EQ(s.find<ScriptedDevice>().read(0.5).buttons, 3u);
}

TEST(ScriptedDevice, mistakesInTablesAreNamedWithTheirPlace) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"", "path.csv: has no poses"},
      {"time,x,y,z\n", "path.csv:1:1: has no poses"},
      {"time,x,y\n", "path.csv:1:1: has 3 columns"},
      {"time,x,y,zz\n", "path.csv:1:10: column 4 is 'zz' instead of 'z'"},
      {"time,x,y,z,qx,qy\n", "columns"},
      {"time,x,y,z\n0,0,0\n", "path.csv:2:1: has 3 values for 4 columns"},
      {"time,x,y,z\n0,0,0,0\n1,0,nan,0\n", "path.csv:3:5: 'nan' is not a finite number"},
      {"time,x,y,z\n0,0,,0\n", "path.csv:2:5: '' is not a finite number"},
      {"time,x,y,z\n1,0,0,0\n1,0,0,0\n", "path.csv:3:1: the time does not rise"},
      {"time,x,y,z,buttons\n1,0,0,0,x\n", "path.csv:2:9: 'x' is not a whole number"},
      {"time,x,y,z,qx,qy,qz,qw\n1,0,0,0,1,1,0,0\n", "path.csv:2:9: the quaternion's length"}};
  for (const auto& [content, expected] : mistakes) {
    const Loaded s = TableFile(content).load();
    EXPECT_FALSE(s.ready);
    EXPECT_NE(s.text().find(expected), std::string::npos) << content << "\n" << s.text();
  }
}

// No races, under the thread sanitizer, between the thread of the hand and what a user does.
TEST(ScriptedDevice, isReadAndWrittenBesideTheSceneInRealTime) {
  const Loaded s = tryTools(wavy, "test.xml", true);
  ASSERT_TRUE(s.ready) << s.text();
  auto& device = s.find<ScriptedDevice>();
  constexpr int count = 20'000;
  std::atomic<bool> ended = false;
  bool counts = true;
  std::thread hand([&] {
    for (int k = 1; k <= count; ++k) {
      counts = counts && device.read(1e-6 * k).sequence == static_cast<std::uint64_t>(k);
      device.write(1e-6 * k, Vec3(k, 0, -k), Vec3(0, k, 0));
    }
    ended = true;
  });
  int torn = 0, backwards = 0, rounds = 0;
  double last = 0;
  for (; !ended || rounds < 50; ++rounds) {
    s.run(1);
    const Vec3 f = device.force, t = device.torque;
    if (f.x() != -f.z() || f.x() != t.y()) ++torn;
    if (f.x() < last) ++backwards;
    last = f.x();
    if (rounds % 7 == 3) {
      EXPECT_TRUE(s.scene->restore(s.scene->save()));
    }
    if (rounds % 11 == 5) s.scene->reset();
  }
  hand.join();
  s.run(1);
  EXPECT_TRUE(counts) << "neither reset nor restore touches what the hand's thread counts";
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(*device.force, Vec3(count, 0, -count)) << "the newest force is shown";
  std::printf("%d steps beside %d ticks\n", rounds, count);
}

TEST(Tools, mistakesAreNamed) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"<ProbeTool/>", "radius"},
      {"<ProbeTool radius='0'/>", "greater than 0"},
      {"<ScalpelTool length='5 mm' sampleCount='0'/>", "sampleCount"},
      {"<ScriptedDevice/>", "has no poses"},
      {"<ScriptedDevice keyTimes='0 1' positions='0 0 0'/>", "1 positions for 2 key times"},
      {"<ScriptedDevice keyTimes='1 0' positions='0 0 0 1 1 1'/>", "does not rise"},
      {"<ScriptedDevice keyTimes='0' positions='0 0 0' orientations='0 0 1'/>", "left over"},
      {"<ScriptedDevice keyTimes='0' positions='0 0 0' orientations='0 0 1 1'/>", "length 1"},
      {"<ScriptedDevice keyTimes='0 1 2' positions='0 0 0 0 0 0 0 0 0' buttons='1 1'/>",
       "2 values for 3 key times"},
      {"<ScriptedDevice keyTimes='0' positions='0 0 0' filename='x.csv'/>", "both"},
      {"<ScriptedDevice filename='missing.csv'/>", "missing.csv"},
      {wavy + "<ProbeTool device='@hand' radius='1 mm'/><Driver/>", "a controller moves this"}};
  for (const auto& [content, expected] : mistakes) {
    const Loaded s = tryTools(content);
    EXPECT_FALSE(s.ready) << content;
    EXPECT_NE(s.text().find(expected), std::string::npos) << content << "\n" << s.text();
  }
}

TEST(Tools, poseIsTheDevicesAtTheEndOfTheStep) {
  const Loaded s = loadTools(wavy + "<ProbeTool device='@hand' radius='1 mm'/>");
  auto& tool = s.find<ProbeTool>();
  auto& device = s.find<ScriptedDevice>();
  for (int k = 1; k <= 35; ++k) {
    s.run(1);
    const ToolSample expected = device.read(s.scene->time());
    EXPECT_NEAR((tool.pose().position - expected.pose.position).norm(), 0, 1e-15);
    EXPECT_EQ(*tool.position, tool.pose().position);
    EXPECT_EQ(tool.linearVelocity(), expected.linearVelocity);
    EXPECT_EQ(tool.active(), (expected.buttons & 1) != 0);
    const Vec3 before = device.read(0.001 * (k - 1)).pose.position;
    EXPECT_NEAR((tool.previousPose().position - before).norm(), 0, 1e-15);
  }
}

TEST(Tools, forcesAddUpAndReachTheDevice) {
  const Loaded s = loadTools(wavy + "<ProbeTool device='@hand' radius='1 mm'/>");
  auto& tool = s.find<ProbeTool>();
  s.run(35);
  Contact contact;
  contact.point = tool.pose().position + Vec3(0, 0, 1);
  contact.depth = 1e-3;
  contact.force = Vec3(2, 0, 0);
  tool.setContacts(std::span(&contact, 1));
  tool.addForce(Vec3(0, 1, 0), tool.pose().position + Vec3(1, 0, 0));
  EXPECT_EQ(tool.totalForce(), Vec3(2, 1, 0));
  EXPECT_NEAR((tool.totalTorque() - Vec3(0, 2, 1)).norm(), 0, 1e-15);
  EXPECT_EQ(*tool.contactCount, 1);
  s.run(1);  // contacts stand until the next ones, other forces for one step
  EXPECT_EQ(tool.totalForce(), Vec3(2, 0, 0));
  EXPECT_EQ(*s.find<ScriptedDevice>().force, Vec3(2, 0, 0));
}

TEST(Tools, poseThatIsNotFiniteMovesNothing) {
  const Loaded s = loadTools("<ProbeTool radius='1 mm'/>");
  auto& tool = s.find<ProbeTool>();
  tool.moveTo({Vec3(1, 2, 3), Quat::Identity()}, Vec3(1, 0, 0), Vec3::Zero(), false);
  tool.moveTo({Vec3(1, std::nan(""), 3), Quat::Identity()}, Vec3::Zero(), Vec3::Zero(), true);
  EXPECT_EQ(tool.pose().position, Vec3(1, 2, 3));
  EXPECT_EQ(tool.linearVelocity(), Vec3::Zero());
  EXPECT_FALSE(tool.active());
  EXPECT_EQ(limiter(tool, "badPoses"), 1u);
}

TEST(Tools, bladesHaveTheirPointsAndEdges) {
  const Loaded s = loadTools(
      "<ScalpelTool length='9 mm'/><KeratomeTool width='2.75 mm' length='3 mm'/>"
      "<ScalpelTool length='9 mm' width='2 mm' sampleCount='1'/>");
  const auto tools = collect<RigidTool>(s.scene->root());
  ASSERT_EQ(tools[0]->samplePoints().size(), 10u);
  EXPECT_EQ(tools[0]->samplePoints()[0], Vec3(0, 0, 0));
  EXPECT_NEAR((tools[0]->samplePoints()[4] - Vec3(0, 0, 4e-3)).norm(), 0, 1e-17);
  EXPECT_EQ(tools[0]->edge()[0], Vec3(0, 0, 9e-3));
  EXPECT_EQ(tools[0]->edge()[1], Vec3(0, 0, 0));
  ASSERT_EQ(tools[1]->edge().size(), 3u);
  EXPECT_NEAR((tools[1]->edge()[0] - tools[1]->edge()[2]).norm(), 2.75e-3, 1e-17);
  EXPECT_EQ(tools[2]->samplePoints().size(), 1u);
  EXPECT_EQ(tools[2]->edge()[0], Vec3(1e-3, 0, 9e-3));
}

TEST(Tools, checkpointContinuesWithTheSameBits) {
  const std::string xml = wavy + "<ProbeTool device='@hand' radius='1 mm'/>";
  const Loaded a = loadTools(xml), b = loadTools(xml);
  a.run(20);
  Contact contact;
  contact.force = Vec3(1, 2, 3);
  contact.triangle = 7;
  a.find<ProbeTool>().setContacts(std::span(&contact, 1));
  ASSERT_TRUE(b.scene->restore(a.scene->save()));
  auto &ta = a.find<ProbeTool>(), &tb = b.find<ProbeTool>();
  EXPECT_EQ(ta.totalForce(), tb.totalForce());
  EXPECT_EQ(tb.contacts()[0].triangle, 7);
  EXPECT_EQ(ta.previousPose().position, tb.previousPose().position);
  EXPECT_EQ(ta.pose().orientation.coeffs(), tb.pose().orientation.coeffs());
}

}  // namespace
}  // namespace stroma::test
