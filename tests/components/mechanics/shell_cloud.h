// SPDX-License-Identifier: Apache-2.0
// Curved bodies for the accuracy tests: a sampled thick sphere and the corneal cap as columns of
// particles in concentric layers.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/mechanics/point_tree.h"
#include "components/sampling/volume_sampler.h"
#include "tests/components/mechanics/point_cloud.h"
#include "tests/components/mechanics/static_solver.h"

namespace stroma::test {

// Point of the sphere of radius r at polar angle theta from +z and azimuth phi.
inline Vec3 onSphere(double r, double theta, double phi) {
  return r *
         Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}

// Polar mesh of the part theta <= maxTheta of a sphere, the whole of it for pi; outward or, turned,
// inward. The last nodes of a part are its rim.
inline void addPolarCap(Cloud& cloud, double r, double maxTheta, int rings, int sectors,
                        bool inward) {
  const auto pole = static_cast<Index>(cloud.nodes.size());
  const bool whole = maxTheta > 3.14;
  const int last = whole ? rings - 1 : rings;  // ring that is no pole
  const auto add = [&](Index a, Index b, Index c) {
    cloud.triangles.push_back(inward ? Triangle{a, c, b} : Triangle{a, b, c});
  };
  cloud.nodes.emplace_back(0, 0, r);
  for (int i = 1; i <= last; ++i)
    for (int j = 0; j < sectors; ++j)
      cloud.nodes.push_back(onSphere(r, maxTheta * i / rings, 2 * std::numbers::pi * j / sectors));
  for (int i = 1; i <= last; ++i)
    for (int j = 0; j < sectors; ++j) {
      const Index ring = pole + 1 + (i - 1) * sectors, next = (j + 1) % sectors;
      if (i == 1) add(pole, ring + j, ring + next);
      if (i == last) continue;
      add(ring + j, ring + j + sectors, ring + next + sectors);
      add(ring + j, ring + next + sectors, ring + next);
    }
  if (!whole) return;
  const auto south = static_cast<Index>(cloud.nodes.size());
  cloud.nodes.emplace_back(0, 0, -r);
  for (int j = 0; j < sectors; ++j)
    add(south, south - sectors + (j + 1) % sectors, south - sectors + j);
}

// Scales the volumes so that they sum to what the surface mesh encloses.
inline void matchEnclosedVolume(Cloud& cloud) {
  double sum = 0;
  for (const double v : cloud.volumes) sum += v;
  const double factor = enclosedVolume(cloud.nodes, cloud.triangles) / sum;
  for (double& v : cloud.volumes) v *= factor;
}

// Hollow sphere between radii a and b, as many particles as a lattice of `layers` cells across
// would have, laid by the volume sampler. The mesh's facets are a quarter of a spacing long or so:
// its volume is within 0.1 % of the sphere's at eight layers.
inline Cloud thickSphere(double a, double b, int layers, unsigned seed) {
  Cloud cloud;
  const double s = cloud.spacing = (b - a) / layers, full = std::numbers::pi;
  addPolarCap(cloud, b, full, 8 * layers, 16 * layers, false);
  addPolarCap(cloud, a, full, 6 * layers, 12 * layers, true);
  VolumeSamplerOptions options;
  options.seed = seed;
  options.count =
      static_cast<Index>(std::lround(enclosedVolume(cloud.nodes, cloud.triangles) / (s * s * s)));
  VolumeSamples samples = sampleVolume(cloud.nodes, cloud.triangles, options);
  if (!samples.problem.empty()) throw std::runtime_error(samples.problem);
  cloud.positions = std::move(samples.positions);
  cloud.volumes = std::move(samples.volumes);
  return cloud;
}

inline constexpr double capRadius = 7.8e-3, capThickness = 0.58e-3, capHalfChord = 5.65e-3;

// Columns on a sunflower spiral over the cap, each with one particle at the middle of every layer.
inline Cloud corneaCap(int columns, int layers) {
  Cloud cloud;
  const double maxTheta = std::asin(capHalfChord / capRadius), inner = capRadius - capThickness;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0)), depth = 1 - std::cos(maxTheta);
  const double middle = capRadius - capThickness / 2;
  const double along = std::sqrt(2 * std::numbers::pi * depth * middle * middle / columns);
  std::vector<Vec3> directions;
  for (int c = 0; c < columns; ++c)
    directions.push_back(onSphere(1, std::acos(1 - depth * (c + 0.5) / columns), golden * c));

  // share of the cap that lies nearest to each column, by a finer spiral of samples
  std::vector<double> share(directions.size(), 0);
  const PointTree tree(directions);
  const int samples = 400 * columns;
  Index owner = 0;
  double squared = 0;
  for (int k = 0; k < samples; ++k) {
    const Vec3 d = onSphere(1, std::acos(1 - depth * (k + 0.5) / samples), golden * k);
    tree.nearest(d, {&owner, 1}, {&squared, 1});
    share[owner] += 1.0 / samples;
  }
  for (int layer = 0; layer < layers; ++layer) {
    const double low = inner + capThickness * layer / layers;
    const double high = inner + capThickness * (layer + 1) / layers;
    for (std::size_t c = 0; c < directions.size(); ++c) {
      cloud.positions.push_back(0.5 * (low + high) * directions[c]);
      cloud.volumes.push_back(share[c] * (std::pow(high, 3) - std::pow(low, 3)));
      cloud.axes.push_back({directions[c], along, capThickness / layers});
    }
  }
  cloud.spacing = along;

  const int rings = 20, sectors = 80;
  addPolarCap(cloud, capRadius, maxTheta, rings, sectors, false);
  const auto rim = static_cast<Index>(cloud.nodes.size()) - sectors;
  addPolarCap(cloud, inner, maxTheta, rings, sectors, true);
  const auto innerRim = static_cast<Index>(cloud.nodes.size()) - sectors;
  for (Index j = 0; j < sectors; ++j) {
    const Index k = (j + 1) % sectors;
    cloud.triangles.push_back({rim + j, innerRim + j, innerRim + k});
    cloud.triangles.push_back({rim + j, innerRim + k, rim + k});
  }
  matchEnclosedVolume(cloud);
  return cloud;
}

// Conjugate gradients with the diagonal as preconditioner, for bodies too large to factorise. The
// load must be balanced; rigid motions stay out of the answer.
template <class Material>
std::vector<Vec3> solveLinearIterative(MlsElasticity<Material>& elasticity, ConstVec3Span X,
                                       ConstVec3Span load) {
  elasticity.prepareTangent(X);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * X.size()));
  elasticity.assembleStiffness([&](Index a, Index b, const Mat3& block) {
    if (a == b) diagonal.segment<3>(3 * a) += block.diagonal();
  });
  std::vector<Vec3> p(X.size()), Kp(X.size());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(diagonal.size()), r = flat(load), z, d;
  const double target = 1e-8 * r.norm();
  double before = 1;
  d = Eigen::VectorXd::Zero(r.size());
  for (int k = 0; r.norm() > target; ++k) {
    if (k == 5000) throw std::runtime_error("conjugate gradients do not converge");
    z = r.cwiseQuotient(diagonal);
    const double now = r.dot(z);
    d = z + (k > 0 ? now / before : 0) * d;
    flat(Vec3Span(p)) = d;
    std::fill(Kp.begin(), Kp.end(), Vec3::Zero());
    elasticity.addStiffnessProduct(1, p, Kp);
    const auto Kd = flat(ConstVec3Span(Kp));
    const double alpha = now / d.dot(Kd);
    u += alpha * d;
    r -= alpha * Kd;
    before = now;
  }
  std::vector<Vec3> out(X.size());
  flat(Vec3Span(out)) = u;
  return out;
}

struct CapResponse {
  double rise, depth;  // of the anterior apex, m
};

// Apex motion with the outermost half spacing of columns held: inflated by 2 kPa from behind,
// indented by 10 mN on a patch.
template <class Material>
CapResponse capResponse(const Body& body, MlsElasticity<Material>& elasticity) {
  const auto& X = body.cloud.positions;
  const double maxTheta = std::asin(capHalfChord / capRadius);
  const double middle = capRadius - capThickness / 2;
  const auto onRim = [&](const Vec3& n, const Vec3& x) {
    return std::abs(n.dot(x.normalized())) < 0.5 && std::acos(x.z() / x.norm()) > maxTheta - 0.02;
  };
  elasticity.prepareTangent(X);
  double patchArea = 0;
  for (const SurfaceSample& sample : body.samples)
    if (sample.position.norm() > middle && sample.area.dot(sample.position) > 0 &&
        sample.position.head<2>().norm() < 0.789e-3)
      patchArea += sample.area.norm();
  SparseMatrix K = stiffnessMatrix(elasticity, static_cast<Index>(X.size()));
  for (Index i = 0; i < static_cast<Index>(X.size()); ++i) {
    const double fromRim = (maxTheta - std::acos(X[i].z() / X[i].norm())) * middle;
    if (fromRim > 0.5 * body.cloud.spacing) continue;
    for (int c = 0; c < 3; ++c) K.coeffRef(3 * i + c, 3 * i + c) *= 1e6;
  }
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factor(K);
  const auto apexMotion = [&](const std::vector<Vec3>& load) {
    std::vector<Vec3> u(X.size());
    flat(Vec3Span(u)) = factor.solve(flat(ConstVec3Span(load)));
    const std::vector<Vec3> apex{Vec3(0, 0, capRadius)};
    std::vector<Vec3> moved(1);
    SurfaceShape(X, body.neighbourhoods, body.gradients, apex).apply(u, moved);
    return moved[0].z();
  };
  const double rise = apexMotion(body.tractionForces([&](const Vec3& x, const Vec3& n) {
    return n.dot(x) < 0 && !onRim(n, x) ? Vec3(-2000 * n) : Vec3(0, 0, 0);
  }));
  const double depth = -apexMotion(body.tractionForces([&](const Vec3& x, const Vec3& n) {
    const bool patch = x.norm() > middle && n.dot(x) > 0 && x.head<2>().norm() < 0.789e-3;
    return patch ? Vec3(0, 0, -0.01 / patchArea) : Vec3(0, 0, 0);
  }));
  return {rise, depth};
}

}  // namespace stroma::test
