// SPDX-License-Identifier: Apache-2.0
// What watching costs the simulation's thread, in CPU time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/rate_keeper.h"
#include "plugins/viewer/browser_viewer.h"
#include "tests/viewer/server/client.h"

namespace stroma {
namespace {

using viewer::TestPage;

SceneOptions quiet() {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.writesOutput = false;
  return options;
}

// A viewer in a scene of its own, with a page that reads and discards.
class Watched {
 public:
  explicit Watched(Scene& shown) : host_(quiet()) {
    host_.registry().add<BrowserViewer>("BrowserViewer");
    const auto folder = std::filesystem::temp_directory_path() / "stroma-cost-page";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "index.html") << "page";
    const bool good =
        host_.loadText("<Node name=\"v\"><BrowserViewer name=\"v\" port=\"0\" token=\"t\" page=\"" +
                           folder.string() + "\"/></Node>",
                       "test") &&
        host_.initialise();
    EXPECT_TRUE(good) << host_.diagnostics().text();
    viewer_ = static_cast<BrowserViewer*>(host_.root().components().front().get());
    viewer_->show(shown, {});
    port_ = std::stoi(viewer_->address().substr(viewer_->address().rfind(':') + 1));
    reader_ = std::jthread([this](const std::stop_token& stop) {
      TestPage page(port_, "/socket?token=t");
      for (const int body : {0, 1}) {
        page.send({{"type", "look"}, {"body", body}, {"field", ""}, {"particles", true}});
      }
      while (!stop.stop_requested()) static_cast<void>(page.nextBinary(50));
    });
  }
  BrowserViewer& viewer() { return *viewer_; }

 private:
  Scene host_;
  BrowserViewer* viewer_ = nullptr;
  int port_ = 0;
  std::jthread reader_;
};

double cpuOf(Scene& scene, int steps, BrowserViewer* viewer) {
  SessionState session;
  session.playing = true;
  const std::int64_t begin = threadCpuNanoseconds();
  for (int i = 0; i < steps; ++i) {
    EXPECT_TRUE(scene.step());
    if (viewer) viewer->publish(session);
  }
  return static_cast<double>(threadCpuNanoseconds() - begin) * 1e-9;
}

TEST(CostOfWatching, isUnderFivePerCentOfTheStep) {
  Scene scene(quiet());
  ASSERT_TRUE(scene.load(STROMA_SCENES "/cornea/pull.xml") && scene.initialise());
  Watched watched(scene);
  static_cast<void>(cpuOf(scene, 20, &watched.viewer()));
  std::vector<double> ratios;
  for (int pair = 0; pair < 15; ++pair) {
    const double without = cpuOf(scene, 15, nullptr);
    const double with = cpuOf(scene, 15, &watched.viewer());
    ratios.push_back(with / without);
  }
  std::ranges::sort(ratios);
  const double frame = watched.viewer().meanFrameCost() * 1e3;
  std::printf("watched over unwatched: %.3f (%.3f to %.3f); %d frames of %.3f ms each\n", ratios[7],
              ratios.front(), ratios.back(), watched.viewer().frames(), frame);
  EXPECT_LT(ratios[7], 1.05);
  EXPECT_GT(watched.viewer().frames(), 15);
  EXPECT_LT(frame, 0.2);
}

// 20,000 particles below a surface of 50,000 triangles.
TEST(CostOfWatching, ofALargeBodyIsUnderTwoMilliseconds) {
  Scene scene(quiet());
  ASSERT_TRUE(scene.loadText(R"(<Node name="root" dt="1 ms" gravity="0 0 0">
    <RegularGridTopology name="grid" n="28 28 26" min="0 0 0" max="0.1 0.1 0.1"/>
    <RegularGridTopology name="skin" n="112 112 2" min="0 0 0.0999" max="0.1 0.1 0.1"/>
    <Node name="body">
      <EulerExplicitSolver name="solver"/>
      <MeshTopology name="mesh" position="@/grid.position"/>
      <MechanicalObject name="state"/>
      <UniformMass totalMass="1 kg"/>
      <UniformVelocityDampingForceField dampingCoefficient="1"/>
    </Node>
    <Node name="surface">
      <EulerExplicitSolver name="solver"/>
      <MeshTopology name="mesh" position="@/skin.position" hexahedra="@/skin.hexahedra"/>
      <MechanicalObject name="state"/>
      <UniformMass totalMass="1 kg"/>
      <UniformVelocityDampingForceField dampingCoefficient="1"/>
    </Node>
  </Node>)",
                             "large.xml") &&
              scene.initialise())
      << scene.diagnostics().text();
  Watched watched(scene);
  static_cast<void>(cpuOf(scene, 400, &watched.viewer()));
  const double frame = watched.viewer().meanFrameCost() * 1e3;
  std::printf("%d particles: %d frames of %.3f ms each\n", scene.particleCount(),
              watched.viewer().frames(), frame);
  EXPECT_GT(watched.viewer().frames(), 5);
  EXPECT_LT(frame, 2.0);
}

}  // namespace
}  // namespace stroma
