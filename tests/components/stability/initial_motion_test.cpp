// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "components/stability/initial_motion.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

class Started {
 public:
  explicit Started(const std::string& attributes) {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    scene = std::make_unique<Scene>(std::move(options));
    ready = scene->loadText(
                "<Node name='root'><RegularGridTopology name='grid' n='3 3 3'/><InitialMotion "
                "name='start' points='@grid.position' " +
                    attributes + "/></Node>",
                "scene.xml") &&
            scene->initialise();
  }
  [[nodiscard]] const std::vector<Vec3>& values(const char* name) const {
    for (const auto& c : scene->root().components()) {
      if (c->name() != "start") continue;
      return dynamic_cast<const Attribute<std::vector<Vec3>>&>(*c->attribute(name)).value();
    }
    throw std::logic_error("no start");
  }
  std::unique_ptr<Scene> scene;
  bool ready = false;
};

TEST(InitialMotion, deformationIsAboutTheMiddle) {
  const Started s("deformation='2 0 0  0 1 0  0 0 0'");
  ASSERT_TRUE(s.ready);
  EXPECT_LT((s.values("position")[0] - Vec3(-0.5, 0, 0.5)).norm(), 1e-15);
  EXPECT_LT((s.values("position")[13] - Vec3(0.5, 0.5, 0.5)).norm(), 1e-15);
}

TEST(InitialMotion, theSameSeedScramblesToTheSameBits) {
  const Started a("scramble='true' seed='3'"), b("scramble='true' seed='3'"),
      c("scramble='true' seed='4'");
  ASSERT_TRUE(a.ready && b.ready && c.ready);
  EXPECT_EQ(a.values("position"), b.values("position"));
  EXPECT_NE(a.values("position"), c.values("position"));
  for (const Vec3& p : a.values("position")) {
    EXPECT_GE(p.minCoeff(), 0);
    EXPECT_LE(p.maxCoeff(), 1);
  }
}

TEST(InitialMotion, checkerboardMovesNeighboursApart) {
  const Started s("checkerboard='0.1' n='3 3 3'");
  ASSERT_TRUE(s.ready);
  const auto& u = s.values("displacement");
  EXPECT_LT((u[0] - Vec3::Constant(0.1)).norm(), 1e-15);
  for (const std::size_t next : {1u, 3u, 9u}) {
    EXPECT_LT((u[next] + Vec3::Constant(0.1)).norm(), 1e-15);
  }
}

TEST(InitialMotion, spinIsAboutTheMiddle) {
  const Started s("angularVelocity='0 0 3' linearVelocity='1 0 0'");
  ASSERT_TRUE(s.ready);
  EXPECT_LT((s.values("velocity")[13] - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((s.values("velocity")[14] - Vec3(1, 1.5, 0)).norm(), 1e-15);
}

TEST(InitialMotion, wrongNumbersAreReported) {
  EXPECT_FALSE(Started("deformation='1 2 3'").ready);
  EXPECT_FALSE(Started("checkerboard='0.1'").ready);
  EXPECT_FALSE(Started("checkerboard='0.1' n='2 2 2'").ready);
}

}  // namespace
}  // namespace stroma
