// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/particle_sampler.h"

#include <gtest/gtest.h>

#include "components/sampling/surface_check.h"
#include "core/scene.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

// A surface without a file: a ball of 1 m, a bent sheet of 10 mm, or that sheet as a shell.
class TestSurface final : public Mesh {
 public:
  Attribute<std::string> shape{this, "shape", "ball", "ball, sheet, shell, broken."};

  void bind() override {
    const SurfaceMesh sheet = shapes::sheet(10e-3, 2e-3, 21);
    mesh_ = shapes::ball(1);
    if (*shape == "sheet") mesh_ = sheet;
    if (*shape == "shell")
      mesh_ = closeSheets(thickenSheet(sheet.positions, sheet.triangles, 0.6e-3));
    if (*shape == "broken") std::swap(mesh_.triangles[0][0], mesh_.triangles[0][1]);
  }
  [[nodiscard]] ConstVec3Span positions() const override { return mesh_.positions; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return mesh_.triangles; }

 private:
  SurfaceMesh mesh_;
};

// A scene of one surface and one sampler.
struct Sampled {
  Scene scene;
  ParticleSampler* sampler = nullptr;
  bool good = false;

  Sampled(const std::string& shape, const std::string& attributes) {
    scene.registry().add<TestSurface>("TestSurface");
    scene.registry().add<ParticleSampler>("ParticleSampler");
    const std::string xml = "<Node><TestSurface name=\"mesh\" shape=\"" + shape +
                            "\"/><ParticleSampler name=\"sampler\" " + attributes + "/></Node>";
    good = scene.loadText(xml, "scene.xml") && scene.initialise();
    for (const auto& c : scene.root().components())
      if (auto* found = dynamic_cast<ParticleSampler*>(c.get())) sampler = found;
  }
  [[nodiscard]] std::string complaints() { return scene.diagnostics().text(); }
};

void expectPartition(const ParticleSampler& s, std::size_t count) {
  ASSERT_EQ(s.positions().size(), count);
  ASSERT_EQ(s.volumes().size(), count);
  const SurfaceView closed = s.enclosingSurface();
  EXPECT_EQ(whyNotClosed(closed.positions, closed.triangles), "");
  const double error =
      shapes::sum(*s.volume) / enclosedVolume(closed.positions, closed.triangles) - 1;
  std::printf("%zu particles, volume error %.2e\n", count, error);
  EXPECT_LT(std::abs(error), 1e-12);
}

TEST(ParticleSampler, everyLayoutPartitionsItsEnclosingSurface) {
  Sampled ball("ball", "count=\"400\"");
  ASSERT_TRUE(ball.good) << ball.complaints();
  expectPartition(*ball.sampler, 400);
  EXPECT_TRUE(ball.sampler->normal->empty());

  Sampled shell("shell", "layout=\"shell\" count=\"600\" layers=\"3\"");
  ASSERT_TRUE(shell.good) << shell.complaints();
  expectPartition(*shell.sampler, 600);
  EXPECT_EQ(shell.sampler->normal->size(), 600u);
  EXPECT_NEAR(*shell.sampler->layerSpacing, 0.2e-3, 0.02e-3);
  EXPECT_FALSE(shell.sampler->rimIndices->indices.empty());

  Sampled lattice("ball", "layout=\"lattice\" n=\"4 5 6\" max=\"4 5 6\" jitter=\"0.2\"");
  ASSERT_TRUE(lattice.good) << lattice.complaints();
  expectPartition(*lattice.sampler, 120);
  EXPECT_NEAR(*lattice.sampler->spacing, 1, 1e-12);
}

TEST(ParticleSampler, openSurfacesAreCappedOrThickened) {
  Sampled capped("sheet", "count=\"200\"");
  ASSERT_TRUE(capped.good) << capped.complaints();
  expectPartition(*capped.sampler, 200);
  Sampled thickened("sheet", "count=\"734\" layout=\"shell\" layers=\"2\" thickness=\"0.0006\"");
  ASSERT_TRUE(thickened.good) << thickened.complaints();
  expectPartition(*thickened.sampler, 734);
}

TEST(ParticleSampler, problemsAreReportedAtTheSampler) {
  const auto complaint = [](const std::string& shape, const std::string& attributes) {
    Sampled s(shape, attributes);
    EXPECT_FALSE(s.good) << attributes;
    return s.complaints();
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(complaint("ball", ""), "needs 'count'");
  says(complaint("broken", "count=\"9\""), "oriented against each other");
  says(complaint("sheet", "layout=\"shell\" count=\"9\""), "the surface is open");
  says(complaint("shell", "layout=\"shell\" count=\"10\""), "cannot be stacked in columns of 3");
  says(complaint("ball", "layout=\"shell\" count=\"9\""), "not a shell");
  says(complaint("ball", "layout=\"lattice\" n=\"0 1 1\""), "at least one particle");
}

}  // namespace
}  // namespace stroma
