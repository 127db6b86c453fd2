// SPDX-License-Identifier: Apache-2.0
// Scenes with the element names, attributes, plugin lines and templates of SOFA load without an
// error or a warning, and move as they should.
#include <gtest/gtest.h>

#include "core/scene.h"

namespace stroma {
namespace {

class SofaScene : public testing::Test {
 protected:
  void run(const std::string& file, int steps) {
    SceneOptions options;
    options.writesOutput = false;
    scene_ = std::make_unique<Scene>(options);
    const bool started =
        scene_->load(std::string(STROMA_TEST_SCENES "/") + file) && scene_->initialise();
    ASSERT_TRUE(started) << scene_->diagnostics().text();
    EXPECT_EQ(scene_->diagnostics().warningCount(), 0) << scene_->diagnostics().text();
    ASSERT_EQ(scene_->systems().size(), 1u);
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(scene_->step());
  }
  [[nodiscard]] System& system() const { return *scene_->systems().front(); }
  // Displacement of a particle.
  [[nodiscard]] Vec3 moved(std::size_t i) const { return system().x()[i] - system().rest()[i]; }

 private:
  std::unique_ptr<Scene> scene_;
};

TEST_F(SofaScene, hangingBarSinksAtItsFreeEndOnly) {
  run("hanging_bar.xml", 50);
  const auto free = static_cast<std::size_t>(system().size() - 1);
  std::printf("hanging bar: end sank by %.2f mm\n", -1000 * moved(free).y());
  EXPECT_EQ(moved(0), Vec3(Vec3::Zero()));
  EXPECT_LT(moved(free).y(), -1e-3);
  EXPECT_GT(moved(free).y(), -0.1);
}

TEST_F(SofaScene, tetheredMassSwingsAndLosesEnergy) {
  run("tethered_mass.xml", 0);
  const auto energy = [&](System& s) {
    return 0.5 * 0.05 * s.v()[0].squaredNorm() + 0.5 * 10 * s.x()[0].squaredNorm();
  };
  const double start = energy(system());
  run("tethered_mass.xml", 400);
  // x'' = -200 x - 0.2 x': energy falls as exp(-0.2 t)
  const double wanted = start * std::exp(-0.2 * 2);
  std::printf("tethered mass: energy after 2 s %.4f of %.4f J, damped oscillator %.4f\n",
              energy(system()), start, wanted);
  EXPECT_NEAR(energy(system()), wanted, 0.05 * wanted);
}

TEST_F(SofaScene, slidingBlockMovesBetweenItsWallsWithTheForcesAcceleration) {
  run("sliding_block.xml", 25);
  Vec3 middle = Vec3::Zero();
  for (Index i = 0; i < system().size(); ++i) middle += moved(static_cast<std::size_t>(i));
  middle /= system().size();
  // F/m t^2/2, less the drag rayleighMass m v
  const double wanted = 0.01 / 0.045 * 0.5 * 0.5 / 2;
  std::printf("sliding block: %.2f mm, without drag %.2f mm\n", 1000 * middle.x(), 1000 * wanted);
  EXPECT_NEAR(middle.x(), wanted, 0.06 * wanted);
  EXPECT_EQ(middle.y(), 0);
  EXPECT_EQ(middle.z(), 0);
}

}  // namespace
}  // namespace stroma
