// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "components/sampling/point_grid.h"
#include "components/sampling/solid_scanner.h"
#include "components/sampling/volume_sampler.h"
#include "core/parallel.h"
#include "tests/components/sampling/shapes.h"

namespace stroma {
namespace {

VolumeSamples sample(const SurfaceMesh& mesh, const VolumeSamplerOptions& options) {
  return sampleVolume(mesh.positions, mesh.triangles, options);
}

double closestPair(const std::vector<Vec3>& x, double spacing) {
  const PointGrid grid(x, spacing);
  double closest = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < static_cast<Index>(x.size()); ++i)
    grid.forEachWithin(x[i], 2 * spacing, [&](Index j, double squared) {
      if (j != i) closest = std::min(closest, std::sqrt(squared));
    });
  return closest;
}

TEST(VolumeSampler, volumesPartitionTheEnclosedVolume) {
  const SurfaceMesh ball = shapes::ball(0.03);
  const double volume = enclosedVolume(ball.positions, ball.triangles);
  for (const Index count : {1, 7, 500, 3024}) {
    const VolumeSamples s = sample(ball, {.count = count});
    ASSERT_EQ(s.problem, "");
    ASSERT_EQ(s.positions.size(), static_cast<std::size_t>(count));
    ASSERT_EQ(s.volumes.size(), static_cast<std::size_t>(count));
    const double error = std::abs(shapes::sum(s.volumes) / volume - 1);
    std::printf("%d particles: volume error %.2e\n", count, error);
    EXPECT_LT(error, 1e-12);
    for (const double v : s.volumes) EXPECT_GT(v, 0);
  }
}

TEST(VolumeSampler, particlesAreInsideAndKeepTheirDistance) {
  // an L, so that there is a re-entrant edge
  SurfaceMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2}, 3);
  for (Vec3& p : mesh.positions)
    if (p[0] > 1.5 && p[1] > 1.5) p.head<2>() = Eigen::Vector2d(1.02, 1.02);
  const VolumeSamples s = sample(mesh, {.count = 1000});
  ASSERT_EQ(s.problem, "");
  const SolidScanner scanner(mesh.positions, mesh.triangles);
  for (const Vec3& p : s.positions) EXPECT_TRUE(scanner.isInside(p));
  const double closest = closestPair(s.positions, s.spacing) / s.spacing;
  const auto [least, most] = std::minmax_element(s.volumes.begin(), s.volumes.end());
  const double mean = shapes::sum(s.volumes) / 1000;
  std::printf("closest pair %.3f spacings, volumes %.3f to %.3f of the mean, %d moved inside\n",
              closest, *least / mean, *most / mean, s.movedInside);
  EXPECT_GT(closest, 0.6);
  EXPECT_GT(*least, 0.4 * mean);
  EXPECT_LT(*most, 1.8 * mean);
}

TEST(VolumeSampler, particlesAreTheCentroidsOfTheirCells) {
  // against Voronoi cells integrated anew, on four times as many samples
  const SurfaceMesh ball = shapes::ball(1);
  const VolumeSamples s = sample(ball, {.count = 800, .relaxations = 20});
  const SolidScanner scanner(ball.positions, ball.triangles);
  const SolidSamples fine = scanner.samples(s.spacing / 10);
  const PointGrid grid(s.positions, s.spacing);
  std::vector<Vec3> moment(s.positions.size(), Vec3::Zero());
  std::vector<double> volume(s.positions.size(), 0);
  Index guess = 0;
  for (std::size_t k = 0; k < fine.positions.size(); ++k) {
    guess = grid.nearest(fine.positions[k], guess);
    volume[guess] += fine.volumes[k];
    moment[guess] += fine.volumes[k] * (fine.positions[k] - s.positions[guess]);
  }
  double squared = 0, volumeSquared = 0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    squared += (moment[i] / volume[i] / s.spacing).squaredNorm();
    volumeSquared += std::pow(volume[i] / s.volumes[i] - 1, 2);
  }
  const double offset = std::sqrt(squared / 800), spread = std::sqrt(volumeSquared / 800);
  std::printf("centroid offset %.4f spacings (rms), volumes differ by %.4f (rms)\n", offset,
              spread);
  EXPECT_LT(offset, 0.03);
  EXPECT_LT(spread, 0.03);
}

TEST(VolumeSampler, secondMomentsAddUpToTheBodys) {
  const Vec3 size(1.0, 0.7, 0.5);
  const SurfaceMesh box = shapes::box(Vec3::Zero(), size);
  const VolumeSamples s = sample(box, {.count = 400, .moments = true});
  ASSERT_EQ(s.secondMoments.size(), 400u);
  Mat3 total = Mat3::Zero();
  for (std::size_t i = 0; i < 400; ++i) {
    const Vec3 d = s.centroids[i] - 0.5 * size;
    total += s.volumes[i] * (s.secondMoments[i] + d * d.transpose());
  }
  total /= size.prod();
  const Mat3 exact = (size.array().square() / 12).matrix().asDiagonal();
  std::printf("second moment error %.2e\n", (total - exact).norm() / exact.norm());
  EXPECT_LT((total - exact).norm(), 5e-3 * exact.norm());
}

TEST(VolumeSampler, sameSeedSameBitsOtherSeedOtherCloud) {
  const SurfaceMesh ball = shapes::ball(0.05);
  const VolumeSamples a = sample(ball, {.count = 600, .seed = 3});
  const VolumeSamples b = sample(ball, {.count = 600, .seed = 3});
  const VolumeSamples c = sample(ball, {.count = 600, .seed = 4});
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.volumes, b.volumes);
  EXPECT_NE(a.positions, c.positions);
}

TEST(VolumeSampler, threadCountDoesNotChangeBits) {
  const SurfaceMesh ball = shapes::ball(0.05);
  setThreadCount(1);
  const VolumeSamples one = sample(ball, {.count = 900, .moments = true});
  setThreadCount(2);
  const VolumeSamples two = sample(ball, {.count = 900, .moments = true});
  setThreadCount(1);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.volumes, two.volumes);
  EXPECT_EQ(one.secondMoments, two.secondMoments);
}

TEST(VolumeSampler, thinPlatesAreFilledToo) {
  const SurfaceMesh plate = shapes::box({0, 0, 0}, {1, 0.02, 1}, 3);
  const VolumeSamples s = sample(plate, {.count = 300});
  ASSERT_EQ(s.problem, "");
  EXPECT_NEAR(shapes::sum(s.volumes), 0.02, 1e-14);
  const SolidScanner scanner(plate.positions, plate.triangles);
  for (const Vec3& p : s.positions) EXPECT_TRUE(scanner.isInside(p));
}

TEST(VolumeSampler, whatCannotBeSampledIsAnswered) {
  SurfaceMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_NE(sample(box, {.count = 0}).problem, "");
  EXPECT_NE(sample(box, {.count = -5}).problem, "");
  EXPECT_NE(sample(box, {.count = 10, .relaxations = -1}).problem, "");
  EXPECT_EQ(sample({}, {.count = 10}).problem, "the mesh has no vertex");
  SurfaceMesh broken = box;
  broken.triangles.pop_back();
  EXPECT_NE(sample(broken, {.count = 10}).problem.find("open rim"), std::string::npos);
  broken = box;
  broken.positions[2][0] = std::numeric_limits<double>::infinity();
  EXPECT_NE(sample(broken, {.count = 10}).problem.find("vertex 2"), std::string::npos);
  broken = box;
  for (Vec3& p : broken.positions) p[0] = 1;
  EXPECT_EQ(sample(broken, {.count = 10}).problem, "the surface encloses no volume");
  // degenerate triangles enclose nothing and do no harm
  box.triangles.push_back({0, 0, 1});
  EXPECT_EQ(sample(box, {.count = 10}).problem, "");
}

}  // namespace
}  // namespace stroma
