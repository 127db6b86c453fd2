// SPDX-License-Identifier: Apache-2.0
// Sessions: what is recorded is what is played, to the bit.
#include "components/haptics/session.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "core/rate_keeper.h"
#include "tests/components/haptics/touch_scene.h"

namespace stroma {
namespace {

namespace fs = std::filesystem;

SessionFrame frameOf(std::uint64_t step) {
  SessionFrame frame;
  frame.step = step;
  return frame;
}

class Session : public testing::Test {
 protected:
  Session()
      : folder_(fs::temp_directory_path() /
                ("stroma-session-" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Session() override { fs::remove_all(folder_); }
  TouchOptions recording() const {
    TouchOptions options;
    options.folder = folder_;
    options.controller = "record=\"hand.session\"";
    return options;
  }
  TouchScene replay(const std::string& file = "hand.session") const {
    TouchOptions options;
    options.folder = folder_;
    options.device = "<ReplayDevice filename=\"" + file + "\"/>";
    return touchScene(options);
  }
  fs::path folder_;
};

TEST_F(Session, textKeepsEveryBit) {
  std::mt19937_64 random(5);
  const auto number = [&] {
    for (;;) {
      const std::uint64_t bits = random();
      double value = 0;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return value;
    }
  };
  const auto vector = [&] { return Vec3(number(), number(), number()); };
  const auto pose = [&] { return Pose{vector(), Quat(number(), number(), number(), number())}; };
  std::string text = sessionHeader();
  std::vector<SessionFrame> written, read;
  for (std::uint64_t step = 1; step <= 1000; ++step) {
    SessionFrame f{step,
                   static_cast<std::uint32_t>(random()),
                   static_cast<std::uint32_t>(random()),
                   pose(),
                   {number(), pose(), vector(), vector(), 0, random()},
                   vector()};
    f.device.buttons = f.buttons;
    text += sessionLine(f);
    written.push_back(f);
  }
  ASSERT_EQ(readSession(text, read), "");
  ASSERT_EQ(read.size(), written.size());
  std::string again = sessionHeader();
  for (const SessionFrame& f : read) again += sessionLine(f);
  EXPECT_EQ(again, text);
  EXPECT_EQ(read[77].device.pose.orientation.coeffs(),
            written[77].device.pose.orientation.coeffs());
  EXPECT_EQ(read[77].tool.position, written[77].tool.position);
  EXPECT_EQ(read[77].force, written[77].force);
}

TEST_F(Session, brokenFilesAreRefusedWithTheirLine) {
  const std::string good = sessionHeader() + sessionLine(frameOf(1)) + sessionLine(frameOf(2));
  std::vector<SessionFrame> frames;
  EXPECT_EQ(readSession(good, frames), "");
  EXPECT_NE(readSession("", frames), "");
  EXPECT_NE(readSession("stroma-session 2\n", frames), "");
  EXPECT_NE(readSession(good + sessionLine(frameOf(2)), frames).find("line 5"), std::string::npos);
  // every cut and every changed letter: read or refused, never a crash
  for (std::size_t at = 0; at < good.size(); ++at) {
    static_cast<void>(readSession(good.substr(0, at), frames));
    for (const char c : {'x', ' ', '-', '\n', '9'}) {
      std::string changed = good;
      changed[at] = c;
      static_cast<void>(readSession(changed, frames));
      for (const SessionFrame& f : frames) ASSERT_TRUE(f.tool.position.allFinite());
    }
  }
  SessionFrame nan = frameOf(3);
  nan.tool.position.y() = std::nan("");
  EXPECT_NE(readSession(good + sessionLine(nan), frames), "");
}

TEST_F(Session, lockStepIsReplayedToTheSameBits) {
  TouchScene recorded = touchScene(recording());
  ASSERT_TRUE(recorded.controller) << recorded.problems;
  recorded.step(150);
  recorded.scene->stop();
  TouchScene replayed = replay();
  ASSERT_TRUE(replayed.controller) << replayed.problems;
  replayed.step(150);
  EXPECT_GT(recorded.tissue->mostForce, 0.1);
  EXPECT_EQ(replayed.tissue->trace, recorded.tissue->trace);
  ASSERT_EQ(recorded.controller->files().size(), 1u);
}

TEST_F(Session, realTimeIsReplayedInLockStepToTheSameBits) {
  TouchOptions options = recording();
  options.realTime = true;
  TouchScene recorded = touchScene(options);
  ASSERT_TRUE(recorded.controller) << recorded.problems;
  RateKeeper pace(100);
  pace.start();
  for (int i = 0; i < 90; ++i) {
    pace.wait();
    recorded.step();
  }
  recorded.scene->stop();
  EXPECT_GT(recorded.tissue->mostForce, 0.05);
  for (int round = 0; round < 2; ++round) {
    TouchScene replayed = replay();
    ASSERT_TRUE(replayed.controller) << replayed.problems;
    replayed.step(90);
    EXPECT_EQ(replayed.tissue->trace, recorded.tissue->trace);
    EXPECT_EQ(replayed.tissue->height, recorded.tissue->height);
  }
}

TEST_F(Session, aResumedRunKeepsTheStepsBefore) {
  TouchScene whole = touchScene(recording());
  ASSERT_TRUE(whole.controller) << whole.problems;
  whole.step(40);
  const Snapshot snapshot = whole.scene->save();
  whole.step(40);
  whole.scene->stop();
  TouchScene resumed = touchScene(recording());
  ASSERT_TRUE(resumed.scene->restore(snapshot));
  resumed.tool->moveTo(whole.tool->pose(), Vec3::Zero(), Vec3::Zero(), false);
  resumed.step(40);
  resumed.scene->stop();
  TouchScene replayed = replay();
  ASSERT_TRUE(replayed.controller) << replayed.problems;
  replayed.step(80);
  EXPECT_EQ(replayed.tissue->trace, whole.tissue->trace);
}

TEST_F(Session, aResumedRunWithoutTheStepsBeforeSaysSo) {
  TouchScene whole = touchScene(recording());
  ASSERT_TRUE(whole.controller) << whole.problems;
  whole.step(20);
  const Snapshot snapshot = whole.scene->save();
  whole.scene->stop();
  const fs::path file = folder_ / "hand.session";
  for (const bool there : {false, true}) {
    fs::remove(file);
    if (there) std::ofstream(file) << "something else";
    TouchScene resumed = touchScene(recording());
    ASSERT_TRUE(resumed.scene->restore(snapshot));
    static_cast<void>(resumed.scene->step());
    EXPECT_NE(resumed.controller->trouble().find("cannot go on"), std::string::npos);
    EXPECT_TRUE(resumed.controller->files().empty());
    EXPECT_EQ(fs::exists(file), there);
    if (there) {
      EXPECT_EQ(fs::file_size(file), 14u) << "left alone";
    }
  }
}

TEST_F(Session, aFileThatIsNoneIsAnError) {
  std::ofstream(folder_ / "bad.session") << "stroma-session 1\n1 2 3\n";
  const TouchScene bad = replay("bad.session");
  EXPECT_NE(bad.problems.find("line 2"), std::string::npos) << bad.problems;
  EXPECT_NE(replay("missing.session").problems.find("file-missing"), std::string::npos);
}

}  // namespace
}  // namespace stroma
