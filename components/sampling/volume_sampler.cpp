// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/volume_sampler.h"

#include <algorithm>
#include <cmath>

#include "components/sampling/blue_noise.h"
#include "components/sampling/point_grid.h"
#include "components/sampling/solid_scanner.h"
#include "components/sampling/surface_check.h"
#include "core/parallel.h"
#include "core/random.h"

namespace stroma {
namespace {

constexpr Index maxParticles = 20'000'000;
constexpr int candidatesPerParticle = 5;
constexpr double overRelaxation = 1.8;  // halves the number of Lloyd steps; the last one is plain

// Sampling lines must also see a body that is thin against its particles.
double sampleCell(double volume, double area, double samples) {
  const double meanThickness = 2 * volume / area;
  const double cubes = std::cbrt(volume / samples);
  return std::max(std::min(cubes, meanThickness / 6), 0.2 * cubes);
}

// Random points of the solid, spread over its samples in proportion to their volume.
std::vector<Vec3> candidates(const SolidSamples& solid, Index count, std::uint64_t seed) {
  double total = 0;
  for (const double v : solid.volumes) total += v;
  UniformRandom random(seed);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(count));
  std::size_t s = 0;
  double passed = 0;
  for (Index c = 0; c < count; ++c) {
    const double target = (c + random()) * total / count;
    while (s + 1 < solid.volumes.size() && passed + solid.volumes[s] <= target)
      passed += solid.volumes[s++];
    const double length = solid.volumes[s] / (solid.dy * solid.dz);
    points.push_back(solid.positions[s] + Vec3((random() - 0.5) * length, 0, 0));
  }
  return points;
}

std::vector<Index> assign(const SolidSamples& solid, const std::vector<Vec3>& seeds,
                          double spacing) {
  const PointGrid grid(seeds, spacing);
  std::vector<Index> owner(solid.positions.size());
  parallelChunks(static_cast<Index>(owner.size()), 4096, [&](Index begin, Index end) {
    Index guess = -1;
    for (Index s = begin; s < end; ++s) owner[s] = guess = grid.nearest(solid.positions[s], guess);
  });
  return owner;
}

struct Cells {
  std::vector<Vec3> centroids;
  std::vector<double> volumes;
};

// A cell that got no sample keeps its seed and no volume.
Cells integrate(const SolidSamples& solid, const std::vector<Index>& owner,
                const std::vector<Vec3>& seeds) {
  Cells cells{std::vector<Vec3>(seeds.size(), Vec3::Zero()), std::vector<double>(seeds.size(), 0)};
  for (std::size_t s = 0; s < owner.size(); ++s) {
    cells.volumes[owner[s]] += solid.volumes[s];
    cells.centroids[owner[s]] += solid.volumes[s] * solid.positions[s];
  }
  for (std::size_t i = 0; i < seeds.size(); ++i)
    cells.centroids[i] =
        cells.volumes[i] > 0 ? Vec3(cells.centroids[i] / cells.volumes[i]) : seeds[i];
  return cells;
}

std::vector<Mat3> secondMoments(const SolidSamples& solid, const std::vector<Index>& owner,
                                const Cells& cells) {
  std::vector<Mat3> moments(cells.volumes.size(), Mat3::Zero());
  for (std::size_t s = 0; s < owner.size(); ++s) {
    const double length = solid.volumes[s] / (solid.dy * solid.dz);
    const Vec3 d = solid.positions[s] - cells.centroids[owner[s]];
    Mat3 m = d * d.transpose();
    m.diagonal() += Vec3(length * length, solid.dy * solid.dy, solid.dz * solid.dz) /
                    12;  // of the sample itself
    moments[owner[s]] += solid.volumes[s] * m;
  }
  for (std::size_t i = 0; i < moments.size(); ++i) moments[i] /= cells.volumes[i];
  return moments;
}

// In a bent or hollow cell the centroid may lie outside: there the particle takes the nearest of
// the cell's own samples.
void moveInside(const SolidScanner& scanner, const SolidSamples& solid,
                const std::vector<Index>& owner, VolumeSamples& out) {
  const auto count = static_cast<Index>(out.positions.size());
  std::vector<std::uint8_t> outside(out.positions.size());
  parallelFor(count, [&](Index i) { outside[i] = !scanner.isInside(out.positions[i]); });
  std::vector<double> nearest(out.positions.size(), std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; s < owner.size(); ++s) {
    const Index i = owner[s];
    if (!outside[i]) continue;
    const double squared = (solid.positions[s] - out.centroids[i]).squaredNorm();
    if (squared >= nearest[i]) continue;
    nearest[i] = squared;
    out.positions[i] = solid.positions[s];
  }
  out.movedInside = static_cast<Index>(std::count(outside.begin(), outside.end(), 1));
}

void scaleTo(double wanted, std::vector<double>& volumes) {
  double sum = 0;
  for (const double v : volumes) sum += v;
  for (double& v : volumes) v *= wanted / sum;
}

}  // namespace

VolumeSamples sampleVolume(ConstVec3Span x, TriangleSpan triangles,
                           const VolumeSamplerOptions& options) {
  VolumeSamples out;
  if (options.count < 1 || options.count > maxParticles)
    out.problem = "the number of particles must be from 1 to " + std::to_string(maxParticles);
  else if (options.relaxations < 0 || options.samplesPerCell < 8 || options.samplesPerCell > 4096)
    out.problem = "relaxations must not be negative, samples a cell must be from 8 to 4096";
  else
    out.problem = whyNotClosed(x, triangles);
  if (!out.problem.empty()) return out;

  const double volume = enclosedVolume(x, triangles);
  const double area = surfaceArea(x, triangles);
  const SolidScanner scanner(x, triangles);
  out.spacing = std::cbrt(volume / options.count);
  const double wanted = static_cast<double>(options.samplesPerCell) * options.count;

  // blue noise
  const double coarse = sampleCell(volume, area, wanted);
  SolidSamples solid = scanner.samples(coarse);
  if (solid.positions.empty()) {
    out.problem = "the body is too thin to be sampled";
    return out;
  }
  const std::vector<Vec3> points =
      candidates(solid, candidatesPerParticle * options.count, options.seed);
  const double closest = std::cbrt(volume / (4 * std::sqrt(2.0) * options.count));
  std::vector<Vec3> seeds;
  for (const Index i : eliminateSamples(points, options.count, closest)) seeds.push_back(points[i]);

  // Lloyd
  for (int step = 1; step <= options.relaxations; ++step) {
    const std::vector<Vec3> targets =
        integrate(solid, assign(solid, seeds, out.spacing), seeds).centroids;
    const double reach = step < options.relaxations ? overRelaxation : 1;
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] += reach * (targets[i] - seeds[i]);
  }

  // final cells
  const double fine = sampleCell(volume, area, 4 * wanted);
  solid = scanner.samples(fine);
  const std::vector<Index> owner = assign(solid, seeds, out.spacing);
  Cells cells = integrate(solid, owner, seeds);
  if (*std::min_element(cells.volumes.begin(), cells.volumes.end()) <= 0) {
    out.problem = "a particle got no volume: the body is too thin for so many particles";
    return out;
  }
  if (options.moments) out.secondMoments = secondMoments(solid, owner, cells);
  out.positions = out.centroids = std::move(cells.centroids);
  out.volumes = std::move(cells.volumes);
  scaleTo(volume, out.volumes);
  moveInside(scanner, solid, owner, out);
  return out;
}

}  // namespace stroma
