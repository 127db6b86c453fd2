// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "components/sampling/shell_sampler.h"
#include "components/sampling/solid_scanner.h"
#include "core/parallel.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

SurfaceMesh bentShell(Index nodesAcross = 25) {
  const SurfaceMesh sheet = shapes::sheet(10e-3, 2e-3, nodesAcross);
  return closeSheets(thickenSheet(sheet.positions, sheet.triangles, 0.6e-3));
}

ShellSamples sample(const SurfaceMesh& mesh, const ShellSamplerOptions& options) {
  return sampleShell(mesh.positions, mesh.triangles, options);
}

TEST(ShellSampler, volumesPartitionTheEnclosedVolume) {
  const SurfaceMesh shell = bentShell();
  const double volume = enclosedVolume(shell.positions, shell.triangles);
  for (const Index layers : {1, 2, 3, 5}) {
    const ShellSamples s = sample(shell, {.count = 200 * layers, .layers = layers});
    ASSERT_EQ(s.problem, "");
    ASSERT_EQ(s.positions.size(), 200u * layers);
    EXPECT_EQ(s.columns, 200);
    const double error = std::abs(shapes::sum(s.volumes) / volume - 1);
    std::printf("%d layers: volume error %.2e\n", layers, error);
    EXPECT_LT(error, 1e-12);
    for (const double v : s.volumes) EXPECT_GT(v, 0);
  }
}

TEST(ShellSampler, particlesOfAColumnAreStraightBelowOneAnother) {
  const SurfaceMesh shell = bentShell();
  const ShellSamples s = sample(shell, {.count = 1200, .layers = 4});
  ASSERT_EQ(s.problem, "");
  double worst = 0;
  for (std::size_t c = 0; c < 1200; c += 4)
    for (std::size_t k = 1; k < 4; ++k) {
      const Vec3 step = s.positions[c + k - 1] - s.positions[c + k];
      const double aside = (step - step.dot(s.normals[c]) * s.normals[c]).norm();
      worst = std::max(worst, aside / step.norm());
      EXPECT_GT(step.dot(s.normals[c]), 0);
      EXPECT_NEAR(step.norm() / s.layerSpacing, 1, 0.1);
      EXPECT_NEAR(s.normals[c + k].norm(), 1, 1e-14);
    }
  std::printf("sideways offset in a column: %.2e of the layer spacing\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(ShellSampler, flatSlabHasEqualLayersAndItsOwnSecondMoment) {
  const SurfaceMesh sheet = shapes::sheet(1, 0, 9);
  const SurfaceMesh slab = closeSheets(thickenSheet(sheet.positions, sheet.triangles, 0.06));
  for (const Index layers : {2, 3, 4}) {
    const ShellSamples s = sample(slab, {.count = 100 * layers, .layers = layers});
    ASSERT_EQ(s.problem, "");
    // n middles of n layers have 1 - 1/n^2 of the slab's second moment
    const double spread = 1 / std::sqrt(1 - 1.0 / (layers * layers)), thick = 0.06 / layers;
    double volume = 0, moment = 0;
    for (Index i = 0; i < 100 * layers; ++i) {
      const double middle = (static_cast<double>(i % layers) + 0.5) * thick - 0.03;
      EXPECT_NEAR(s.positions[i][2], -0.03 - spread * middle, 1e-12);
      EXPECT_NEAR(s.thicknesses[i], thick, 1e-12);
      EXPECT_NEAR((s.normals[i] - Vec3::UnitZ()).norm(), 0, 1e-12);
      EXPECT_NEAR(s.volumes[i], s.volumes[i - i % layers], 1e-12 * s.volumes[i]);
      volume += s.volumes[i];
      moment += s.volumes[i] * std::pow(s.positions[i][2] + 0.03, 2);
    }
    EXPECT_NEAR(moment / volume, 0.06 * 0.06 / 12, 1e-12);
    EXPECT_NEAR(s.tangentialSpacing, 0.1, 1e-12);
    EXPECT_NEAR(s.layerSpacing, thick, 1e-12);
  }
}

TEST(ShellSampler, particlesAreInsideAndColumnsKeepTheirDistance) {
  const SurfaceMesh shell = bentShell();
  const ShellSamples s = sample(shell, {.count = 1500, .layers = 3});
  const SolidScanner scanner(shell.positions, shell.triangles);
  for (const Vec3& p : s.positions) EXPECT_TRUE(scanner.isInside(p));
  double closest = 1;
  for (std::size_t a = 1; a < 1500; a += 3)
    for (std::size_t b = 1; b < a; b += 3)
      closest = std::min(closest, (s.positions[a] - s.positions[b]).norm());
  std::printf("closest columns: %.3f spacings\n", closest / s.tangentialSpacing);
  EXPECT_GT(closest, 0.6 * s.tangentialSpacing);
}

TEST(ShellSampler, rimParticlesAreThoseWhoseCellsTouchTheRim) {
  const SurfaceMesh sheet = shapes::sheet(1, 0, 9);
  const SurfaceMesh slab = closeSheets(thickenSheet(sheet.positions, sheet.triangles, 0.05));
  const ShellSamples s = sample(slab, {.count = 800, .layers = 2});
  std::vector<bool> atRim(800, false);
  for (const Index i : s.rim) atRim[i] = true;
  for (std::size_t i = 0; i < 800; ++i) {
    const double fromRim = 0.5 - s.positions[i].head<2>().cwiseAbs().maxCoeff();
    if (fromRim < 0.3 * s.tangentialSpacing) {
      EXPECT_TRUE(atRim[i]);
    }
    if (fromRim > 1.2 * s.tangentialSpacing) {
      EXPECT_FALSE(atRim[i]);
    }
  }
  EXPECT_TRUE(std::is_sorted(s.rim.begin(), s.rim.end()));
}

TEST(ShellSampler, closedShellsHaveNoRim) {
  SurfaceMesh shell = shapes::ball(7.6e-3);
  const auto offset = static_cast<Index>(shell.positions.size());
  const SurfaceMesh inside = shapes::ball(7.0e-3);
  shell.positions.insert(shell.positions.end(), inside.positions.begin(), inside.positions.end());
  for (const Triangle& t : inside.triangles)
    shell.triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  const ShellSamples s = sample(shell, {.count = 1200, .layers = 3});
  ASSERT_EQ(s.problem, "");
  EXPECT_TRUE(s.rim.empty());
  const double volume = enclosedVolume(shell.positions, shell.triangles);
  EXPECT_LT(std::abs(shapes::sum(s.volumes) / volume - 1), 1e-12);
  EXPECT_NEAR(s.layerSpacing, 0.2e-3, 5e-6);
}

TEST(ShellSampler, sameBitsForTheSameSeedAtAnyThreadCount) {
  const SurfaceMesh shell = bentShell();
  setThreadCount(1);
  const ShellSamples one = sample(shell, {.count = 1500, .seed = 9});
  setThreadCount(2);
  const ShellSamples two = sample(shell, {.count = 1500, .seed = 9});
  setThreadCount(1);
  const ShellSamples other = sample(shell, {.count = 1500, .seed = 10});
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.volumes, two.volumes);
  EXPECT_EQ(one.rim, two.rim);
  EXPECT_NE(one.positions, other.positions);
}

TEST(ShellSampler, openSheetsAreSampledWithTheirThickness) {
  const SurfaceMesh sheet = shapes::sheet(10e-3, 2e-3);
  const ShellSheets sheets = thickenSheet(sheet.positions, sheet.triangles, 0.6e-3);
  const SurfaceMesh closed = closeSheets(sheets);
  const double volume = enclosedVolume(closed.positions, closed.triangles);
  const ShellSamples s = sampleShell(sheets, volume, {.count = 734, .layers = 2});
  ASSERT_EQ(s.problem, "");
  EXPECT_EQ(s.columns, 367);
  EXPECT_LT(std::abs(shapes::sum(s.volumes) / volume - 1), 1e-12);
}

TEST(ShellSampler, whatCannotBeStackedIsAnswered) {
  const SurfaceMesh shell = bentShell();
  EXPECT_EQ(sample(shell, {.count = 734, .layers = 3}).problem,
            "734 particles cannot be stacked in columns of 3; 732 or 735 can");
  EXPECT_NE(sample(shell, {.count = 0}).problem, "");
  EXPECT_NE(sample(shell, {.count = 3, .layers = 0}).problem, "");
  EXPECT_NE(sample({}, {.count = 3}).problem, "");
  EXPECT_NE(sample(shapes::ball(1), {.count = 300}).problem.find("not a shell"), std::string::npos);
  EXPECT_NE(sample(shapes::box({0, 0, 0}, {1, 1, 1}), {.count = 300}).problem, "");
  EXPECT_NE(sample(shapes::sheet(1, 0.1), {.count = 300}).problem.find("open rim"),
            std::string::npos);
  ShellSheets crossed;
  const SurfaceMesh sheet = shapes::sheet(1, 0);
  crossed = thickenSheet(sheet.positions, sheet.triangles, -0.1);
  EXPECT_NE(sampleShell(crossed, 0.1, {.count = 300}).problem, "");
}

}  // namespace
}  // namespace stroma
