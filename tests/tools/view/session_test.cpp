// SPDX-License-Identifier: Apache-2.0
// A session with somebody who watches: scenes are changed, gone back in and read again while they
// run, and what cannot be taken leaves the last good one running.
#include "tools/view/session.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/interfaces/mesh.h"
#include "core/traverse.h"

namespace stroma::view {
namespace {

namespace fs = std::filesystem;
using Kind = ViewerRequest::Kind;

// Notes what it is told and asks for what the test says.
class Watcher final : public Viewer {
 public:
  [[nodiscard]] std::string address() const override { return "nowhere"; }
  void show(Scene& scene, const std::vector<std::string>& changes) override {
    scene_ = &scene;
    changes_ = changes;
    ++shown;
  }
  void publish(const SessionState& session) override { last = session; }
  void report(const Diagnostics& diagnostics) override {
    errors = diagnostics.errorCount();
    text = diagnostics.text();
  }
  [[nodiscard]] std::vector<ViewerRequest> takeRequests() override {
    return std::exchange(requests, {});
  }
  void answer(std::uint64_t, bool done, const std::string& what) override {
    answered = done;
    reply = what;
  }

  Scene* scene_ = nullptr;
  std::vector<std::string> changes_;
  std::vector<ViewerRequest> requests;
  SessionState last;
  int shown = 0, errors = 0;
  bool answered = false;
  std::string text, reply;
};

constexpr const char* block = R"(<Node name="root" dt="5 ms" gravity="0 0 0">
  <RegularGridTopology name="grid" n="5 3 3" min="0 0 0" max="0.04 0.02 0.02"/>
  <Node name="block">
    <EulerImplicitSolver name="solver"/>
    <CGLinearSolver name="linear" iterations="60" tolerance="1e-8"/>
    <MeshTopology name="mesh" position="@/grid.position" hexahedra="@/grid.hexahedra"/>
    <MechanicalObject name="state"/>
    <UniformMass totalMass="0.02 kg"/>
    <HexahedronFEMForceField name="elasticity" youngModulus="5 kPa" poissonRatio="0.3"/>
    <BoxROI name="held" box="-1 -1 -1 0.001 1 1"/>
    <FixedProjectiveConstraint indices="@held.indices"/>
    <BoxROI name="end" box="0.039 -1 -1 1 1 1"/>
    <ConstantForceField name="load" indices="@end.indices" totalForce="0 0 -0.02"/>
  </Node>
</Node>
)";

class SessionOf : public ::testing::Test {
 protected:
  SessionOf() {
    folder_ = fs::temp_directory_path() / ("stroma-session-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "block.xml";
    write(block);
    SceneOptions options;
    options.pluginFolders = {STROMA_MODULES_FOLDER};
    options.writesOutput = false;
    session_ = std::make_unique<Session>(file_, options, watcher_);
  }
  ~SessionOf() override {
    session_.reset();
    fs::remove_all(folder_);
  }
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  [[nodiscard]] bool ask(ViewerRequest request) {
    watcher_.requests = {std::move(request)};
    session_->serve();
    return watcher_.answered;
  }
  [[nodiscard]] Vec3 tip() const {
    const auto states = collect<MechanicalState>(session_->scene().root());
    return states.front()->x()[4];
  }
  // Runs until `ends` or for ten seconds.
  void runUntil(bool playing, const std::function<bool()>& ends) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    session_->run(playing, [&] { return ends() || std::chrono::steady_clock::now() > last; });
    EXPECT_TRUE(ends());
  }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
  }

  fs::path folder_, file_;
  Watcher watcher_;
  std::unique_ptr<Session> session_;
};

TEST_F(SessionOf, aRuntimeAttributeChangesAtOnceAndOutlivesAReload) {
  ASSERT_TRUE(session_->open()) << session_->diagnostics().text();
  ASSERT_TRUE(session_->advanceTo(1));
  const double before = tip().z();
  ASSERT_TRUE(ask({Kind::set, "/block/elasticity.youngModulus", "10 kPa"})) << watcher_.reply;
  EXPECT_EQ(watcher_.shown, 1);  // the same scene
  ASSERT_TRUE(session_->advanceTo(2));
  const double rest = 0.0;
  EXPECT_NEAR((tip().z() - rest) / (before - rest), 0.5, 0.1);
  ASSERT_TRUE(ask({Kind::reload}));
  EXPECT_EQ(watcher_.shown, 2);
  EXPECT_EQ(watcher_.changes_.size(), 1u);
  EXPECT_EQ(
      session_->scene().root().children()[0]->components()[5]->attribute("youngModulus")->number(),
      10000);
}

TEST_F(SessionOf, aChangeThatNeedsARestartGoesOnFromTheState) {
  ASSERT_TRUE(session_->open());
  ASSERT_TRUE(session_->advanceTo(0.2));
  const std::uint64_t hash = session_->scene().stateHash();
  const double time = session_->scene().time();
  ASSERT_TRUE(ask({Kind::set, "/block/elasticity.method", "large"})) << watcher_.reply;
  EXPECT_EQ(watcher_.shown, 2);
  EXPECT_EQ(session_->scene().stateHash(), hash);
  EXPECT_DOUBLE_EQ(session_->scene().time(), time);
}

TEST_F(SessionOf, aForceFieldIsSwappedAndTheSwapIsUndone) {
  ASSERT_TRUE(session_->open());
  ASSERT_TRUE(session_->advanceTo(0.2));
  const std::uint64_t hash = session_->scene().stateHash();
  ASSERT_TRUE(ask({Kind::replace, "/block/linear", "SparseLDLSolver"})) << watcher_.reply;
  ASSERT_TRUE(ask({Kind::replace, "/block/solver", "StaticSolver"})) << watcher_.reply;
  EXPECT_EQ(session_->scene().stateHash(), hash);
  EXPECT_EQ(watcher_.changes_.size(), 2u);
  ASSERT_TRUE(ask({Kind::undo}));
  EXPECT_EQ(session_->scene().root().children()[0]->components()[0]->type(), "EulerImplicitSolver");
  ASSERT_TRUE(ask({Kind::revert}));
  EXPECT_TRUE(watcher_.changes_.empty());
  EXPECT_EQ(session_->scene().stepCount(), 0u);
}

TEST_F(SessionOf, aSwapThatCannotBeMadeSaysWhyAndChangesNothing) {
  ASSERT_TRUE(session_->open());
  Scene* const before = &session_->scene();
  EXPECT_FALSE(ask({Kind::replace, "/block/elasticity", "TetrahedronFEMForceField"}));
  EXPECT_FALSE(watcher_.reply.empty());
  EXPECT_GT(watcher_.errors, 0);
  EXPECT_FALSE(ask({Kind::replace, "/block/elasticity", "NoSuchForceField"}));
  EXPECT_FALSE(ask({Kind::replace, "/block/nothing", "SparseLDLSolver"}));
  EXPECT_FALSE(ask({Kind::insert, "/block", "<Broken"}));
  EXPECT_FALSE(ask({Kind::set, "/block/elasticity.youngModulus", "-3"}));
  EXPECT_FALSE(ask({Kind::set, "/block/elasticity.noSuch", "3"}));
  EXPECT_EQ(&session_->scene(), before);
}

TEST_F(SessionOf, theTimeGoesBackToAKeptState) {
  ASSERT_TRUE(session_->open());
  runUntil(true, [&] { return session_->state().kept.size() >= 3; });
  const double kept = session_->state().kept[1];
  ASSERT_TRUE(ask({Kind::rewind, "", "", kept})) << watcher_.reply;
  EXPECT_DOUBLE_EQ(session_->scene().time(), kept);
  const std::uint64_t hash = session_->scene().stateHash();
  ASSERT_TRUE(ask({Kind::reset}));
  ASSERT_TRUE(session_->advanceTo(kept));
  EXPECT_EQ(session_->scene().stateHash(), hash);  // the same bits as the first time
}

TEST_F(SessionOf, savingTheFileShowsItAnewFromItsState) {
  ASSERT_TRUE(session_->open());
  ASSERT_TRUE(session_->advanceTo(0.5));
  const std::uint64_t hash = session_->scene().stateHash();
  write(with(block, "5 kPa", "50 kPa"));
  runUntil(false, [&] { return watcher_.shown == 2; });
  EXPECT_EQ(session_->scene().stateHash(), hash);

  write(with(block, "youngModulus", "yougModulus"));
  runUntil(false, [&] { return watcher_.errors > 0; });
  EXPECT_EQ(watcher_.shown, 2);  // the last good one goes on
  EXPECT_NE(watcher_.text.find("block.xml:9:"), std::string::npos) << watcher_.text;
  EXPECT_NE(watcher_.text.find("did you mean 'youngModulus'"), std::string::npos);

  write(with(block, "n=\"5 3 3\"", "n=\"6 3 3\""));  // another body: from its start
  runUntil(false, [&] { return watcher_.shown == 3; });
  EXPECT_EQ(watcher_.errors, 0);
  EXPECT_EQ(session_->scene().stepCount(), 0u);
}

TEST_F(SessionOf, theChangedSceneIsWrittenAndRunsAlike) {
  ASSERT_TRUE(session_->open());
  ASSERT_TRUE(ask({Kind::set, "/block/elasticity.youngModulus", "8 kPa"}));
  ASSERT_TRUE(ask({Kind::replace, "/block/linear", "SparseLDLSolver"}));
  ASSERT_TRUE(ask({Kind::insert, "/block",
                   "<Monitor name=\"m\" attribute=\"@load.totalForce\" "
                   "component=\"z\"/>"}))
      << watcher_.text;
  ASSERT_TRUE(ask({Kind::sceneText}));
  const std::string text = watcher_.reply;
  EXPECT_NE(text.find("youngModulus=\"8 kPa\""), std::string::npos) << text;
  EXPECT_NE(text.find("<SparseLDLSolver name=\"linear\""), std::string::npos) << text;
  ASSERT_TRUE(session_->advanceTo(0.1));
  Scene again(session_->scene().options());
  ASSERT_TRUE(again.loadText(text, file_) && again.initialise()) << again.diagnostics().text();
  while (again.stepCount() < session_->scene().stepCount()) ASSERT_TRUE(again.step());
  EXPECT_EQ(again.stateHash(), session_->scene().stateHash());
}

TEST_F(SessionOf, playsAtTheAskedSpeed) {
  ASSERT_TRUE(session_->open());
  ASSERT_TRUE(ask({Kind::speed, "", "", 0.2}));
  const auto begin = std::chrono::steady_clock::now();
  runUntil(true, [&] { return session_->scene().time() >= 0.2; });
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GT(wall, 0.95);
  const std::uint64_t steps = session_->scene().stepCount();
  watcher_.requests = {{Kind::step, "", "", 3}};
  int rounds = 0;
  runUntil(false, [&] { return ++rounds > 20; });
  EXPECT_EQ(session_->scene().stepCount(), steps + 3);
}

TEST_F(SessionOf, aDivergenceStopsTheClockAndOneCanGoBack) {
  write(with(block, "dt=\"5 ms\"", "dt=\"1 ms\""));
  ASSERT_TRUE(session_->open());
  // a speed that no number holds any more
  runUntil(true, [&] { return session_->state().kept.size() >= 2; });
  collect<MechanicalState>(session_->scene().root()).front()->v()[20] =
      Vec3::Constant(std::numeric_limits<double>::infinity());
  runUntil(true, [&] { return !session_->state().stopped.empty(); });
  EXPECT_FALSE(session_->state().playing);
  EXPECT_FALSE(ask({Kind::play}));
  ASSERT_TRUE(ask({Kind::rewind, "", "", 0.05}));
  EXPECT_TRUE(session_->state().stopped.empty());
  ASSERT_TRUE(ask({Kind::play}));
}

// A body that has been cut goes on cut when something else is changed.
TEST(SessionOfACut, goesOnCut) {
  Watcher watcher;
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.writesOutput = false;
  Session session(STROMA_SCENES "/paper/cut.xml", options, watcher);
  ASSERT_TRUE(session.open()) << session.diagnostics().text();
  const auto triangles = [&] {
    std::size_t most = 0;
    for (const Topology* t : collect<Topology>(session.scene().root())) {
      most = std::max(most, t->triangles().size());
    }
    return most;
  };
  const std::size_t whole = triangles();
  ASSERT_TRUE(session.advanceTo(session.scene().root().duration * 0.6));
  const std::size_t cut = triangles();
  ASSERT_GT(cut, whole);
  const std::uint64_t hash = session.scene().stateHash();
  watcher.requests = {{Kind::reload, "", ""}};
  session.serve();
  EXPECT_TRUE(watcher.answered) << watcher.reply;
  EXPECT_EQ(triangles(), cut);
  EXPECT_EQ(session.scene().stateHash(), hash);
  watcher.requests = {{Kind::reset, "", ""}};
  session.serve();
  EXPECT_EQ(triangles(), whole);
}

}  // namespace
}  // namespace stroma::view
