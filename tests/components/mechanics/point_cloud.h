// SPDX-License-Identifier: Apache-2.0
// Bodies for the tests of the point-based numerics: jittered boxes whose particle volumes partition
// the box, closed surface meshes around them, and everything that a force needs, built in order.
#pragma once

#include <memory>
#include <random>

#include "components/mechanics/consistent_gradient.h"
#include "components/mechanics/mls_elasticity.h"
#include "components/mechanics/second_order.h"
#include "components/mechanics/surface_quadrature.h"
#include "components/mechanics/surface_shape.h"

namespace stroma::test {

struct Cloud {
  std::vector<Vec3> positions;
  std::vector<double> volumes;
  std::vector<Vec3> nodes;  // closed surface
  std::vector<Triangle> triangles;
  std::vector<EllipsoidAxes> axes;  // only for layered shells
  double spacing = 1;
};

// Two triangles for every quad of a grid over the parallelogram (origin, a, b), normal a x b.
inline void addGrid(Cloud& cloud, const Vec3& origin, const Vec3& a, const Vec3& b, int na,
                    int nb) {
  const auto first = static_cast<Index>(cloud.nodes.size());
  for (int j = 0; j <= nb; ++j)
    for (int i = 0; i <= na; ++i) cloud.nodes.push_back(origin + a * i / na + b * j / nb);
  for (int j = 0; j < nb; ++j)
    for (int i = 0; i < na; ++i) {
      const Index n = first + j * (na + 1) + i;
      cloud.triangles.push_back({n, n + 1, n + na + 2});
      cloud.triangles.push_back({n, n + na + 2, n + na + 1});
    }
}

inline void addBoxSurface(Cloud& cloud, const Eigen::Vector3i& n) {
  const double s = cloud.spacing;
  const Vec3 x(n[0] * s, 0, 0), y(0, n[1] * s, 0), z(0, 0, n[2] * s), o = Vec3::Zero();
  addGrid(cloud, o, y, x, n[1], n[0]);
  addGrid(cloud, z, x, y, n[0], n[1]);
  addGrid(cloud, o, x, z, n[0], n[2]);
  addGrid(cloud, y, z, x, n[2], n[0]);
  addGrid(cloud, o, z, y, n[2], n[1]);
  addGrid(cloud, x, y, z, n[1], n[2]);
}

// Cell-centred lattice of n cells of the given spacing, jittered uniformly by +-jitter spacings.
// Volumes: Voronoi cells clipped to the box, by sub-samples, scaled to sum to the box exactly.
inline Cloud boxCloud(const Eigen::Vector3i& n, double jitter, unsigned seed, double spacing = 1) {
  Cloud cloud;
  cloud.spacing = spacing;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const auto id = [&n](int x, int y, int z) { return x + n[0] * (y + n[1] * z); };
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const double dx = shift(random), dy = shift(random), dz = shift(random);
        cloud.positions.push_back(spacing * Vec3(x + 0.5 + dx, y + 0.5 + dy, z + 0.5 + dz));
      }
  constexpr int sub = 8;
  cloud.volumes.assign(cloud.positions.size(), 0);
  const double piece = std::pow(spacing / sub, 3);
  for (int z = 0; z < n[2] * sub; ++z)
    for (int y = 0; y < n[1] * sub; ++y)
      for (int x = 0; x < n[0] * sub; ++x) {
        const Vec3 p = (Vec3(x, y, z) + Vec3::Constant(0.5)) * spacing / sub;
        double nearest = 1e300;
        int owner = 0;
        for (int c = std::max(0, z / sub - 1); c <= std::min(n[2] - 1, z / sub + 1); ++c)
          for (int b = std::max(0, y / sub - 1); b <= std::min(n[1] - 1, y / sub + 1); ++b)
            for (int a = std::max(0, x / sub - 1); a <= std::min(n[0] - 1, x / sub + 1); ++a) {
              const double d = (cloud.positions[id(a, b, c)] - p).squaredNorm();
              if (d < nearest) nearest = d, owner = id(a, b, c);
            }
        cloud.volumes[owner] += piece;
      }
  addBoxSurface(cloud, n);
  return cloud;
}

enum class GradientKind { plain, fewIterations, exact, secondOrder };

struct BodyOptions {
  Index neighbours = 12;  // 0: all within radius
  double radius = 0;
  double control = 0.3;  // alpha, in units of Young's modulus
  double youngModulus = 1000;
  GradientKind gradient = GradientKind::exact;
  Index supports = 1;       // particles that carry a surface sample
  double sampleEdge = 0.5;  // in spacings
  int iterations = 8;
  Kernel kernel = Kernel::mueller2003;
  double reach = 1.2;
};

// Everything built from a cloud; loads on `samples` travel through `shape`.
struct Body {
  Cloud cloud;
  Neighbourhoods neighbourhoods;
  Gradients gradients;
  TransposedRows transposed;
  std::vector<SurfaceSample> samples;
  SurfaceShape shape;
  ProjectionReport projection;
  std::unique_ptr<MlsBonds> bonds;

  Body(Cloud from, const BodyOptions& options) : cloud(std::move(from)) {
    const auto& X = cloud.positions;
    SupportOptions support;
    support.count = options.neighbours;
    support.radius = options.radius;
    support.kernel = options.kernel;
    support.reach = options.reach;
    if (!cloud.axes.empty()) support.shape = SupportShape::ellipsoid;
    neighbourhoods = findNeighbourhoods(X, support, cloud.axes);
    gradients = computeGradients(X, neighbourhoods);
    transposed = transpose(neighbourhoods);
    samples = sampleSurface(cloud.nodes, cloud.triangles, options.sampleEdge * cloud.spacing);
    std::vector<Vec3> points, areas, boundary(X.size(), Vec3::Zero());
    for (const SurfaceSample& s : samples) points.push_back(s.position), areas.push_back(s.area);
    shape = SurfaceShape(X, neighbourhoods, gradients, points, options.supports);
    shape.addTransposed(areas, boundary);
    std::vector<double> weights = cloud.volumes;
    if (options.gradient == GradientKind::secondOrder) {
      refitOneSided(X, neighbourhoods, gradients);
      weights = quadratureWeights(X, neighbourhoods, transposed, gradients, weights);
    }
    if (options.gradient != GradientKind::plain)
      projection = makeConsistent(X, neighbourhoods, transposed, weights, boundary, gradients,
                                  {options.iterations, options.gradient == GradientKind::exact});
    bonds = std::make_unique<MlsBonds>(X, neighbourhoods, transposed, gradients, weights,
                                       options.control * options.youngModulus);
  }

  // Particle forces of a traction (Pa) given as a function of position and unit normal.
  template <class Traction>
  [[nodiscard]] std::vector<Vec3> tractionForces(Traction&& traction) const {
    std::vector<Vec3> onSamples, forces(cloud.positions.size(), Vec3::Zero());
    for (const SurfaceSample& s : samples)
      onSamples.push_back(traction(s.position, Vec3(s.area.normalized())) * s.area.norm());
    shape.addTransposed(onSamples, forces);
    return forces;
  }
};

}  // namespace stroma::test
