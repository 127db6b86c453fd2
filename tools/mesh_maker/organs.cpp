// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/organs.h"

#include <cmath>
#include <numbers>

#include "tools/mesh_maker/level_set.h"
#include "tools/mesh_maker/rings.h"

namespace stroma::meshes {
namespace {

// Shapes are described in centimetres.
constexpr double centimetre = 0.01;

double liverLevel(const Vec3& p) {
  const double right = ellipsoid(p, {-3.4, 0.6, -0.4}, {5.9, 5.8, 6.0});
  const double left = ellipsoid(p, {4.4, -1.0, 2.4}, {6.0, 4.2, 2.1});
  const double underside = ellipsoid(p, {3.0, 4.5, -10.5}, {12.0, 11.5, 11.0});
  const double notch = ellipsoid(p, {1.8, -5.6, -0.4}, {1.0, 2.2, 2.8});
  const double lobes = smoothUnion(right, left, 3.5);
  return smoothDifference(smoothDifference(lobes, underside, 1.4), notch, 2.2);
}

// A sphere of two poles and rings between them, each node thrown from `middle` onto the level set.
SurfaceMesh thrownSphere(const LevelSet& f, const Vec3& middle, Index nodes, int rings) {
  std::vector<double> circumference;
  for (int k = 0; k < rings; ++k)
    circumference.push_back(std::sin(std::numbers::pi * (k + 1) / (rings + 1)));
  const std::vector<Ring> all = makeRings(shareOut(nodes - 2, circumference), 1, true);
  SurfaceMesh mesh;
  const auto addNode = [&](const Vec3& direction) {
    mesh.positions.push_back(middle + castRay(f, middle, direction, 15) * direction);
  };
  addNode(Vec3::UnitZ());
  for (int k = 0; k < rings; ++k) {
    const double polar = std::numbers::pi * (k + 1) / (rings + 1);
    for (Index i = 0; i < all[k].count; ++i) {
      const double angle = 2 * std::numbers::pi * turn(all[k], i);
      addNode(
          {std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)});
    }
  }
  addNode(-Vec3::UnitZ());

  addFan(0, all.front(), mesh.triangles);
  for (int k = 1; k < rings; ++k) addBand(all[k - 1], all[k], mesh.triangles);
  std::vector<Triangle> bottom;
  addFan(nodes - 1, all.back(), bottom);
  for (const Triangle& t : bottom) mesh.triangles.push_back({t[0], t[2], t[1]});
  return mesh;
}

// The stomach's axis from oesophagus to duodenum, and its radius when filled.
struct Station {
  Vec3 at;
  double radius;
};
const std::array<Station, 8> stations = {{{{0.2, 0, 10.4}, 1.1},
                                          {{1.7, 0.3, 7.2}, 1.1},
                                          {{3.4, 0.2, 4.4}, 3.2},
                                          {{2.9, 0, -0.4}, 2.9},
                                          {{0.6, -0.5, -3.4}, 2.3},
                                          {{-2.6, -0.3, -3.0}, 1.7},
                                          {{-4.6, 0.3, -0.9}, 1.1},
                                          {{-4.9, 0.9, 1.6}, 1.25}}};
const Vec3 fundus(4.4, 0.4, 7.0);

// `filling` from 0, a thin tube, to 1.
double stomachLevel(const Vec3& p, double filling) {
  constexpr double emptyRadius = 1.1;
  const auto radius = [&](const Station& s) {
    return emptyRadius + filling * (s.radius - emptyRadius);
  };
  // the ends run on beyond the rims, which so lie on a plain tube
  double level = 1e3;
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    const Station &a = stations[k], &b = stations[k + 1];
    Vec3 from = a.at, to = b.at;
    if (k == 0) from += a.at - b.at;
    if (k + 2 == stations.size()) to += b.at - a.at;
    level = smoothUnion(level, taperedRod(p, from, radius(a), to, radius(b)), 0.5);
  }
  // the fundus grows out of the body
  const Vec3 center = stations[2].at + filling * (fundus - stations[2].at);
  const double size = 0.6 + 0.4 * filling;
  return smoothUnion(level, ellipsoid(p, center, size * Vec3(3.0, 2.9, 3.2)) + 2 * (1 - filling),
                     1.2);
}

// Point and direction at a share of the axis' length, corners rounded.
struct AxisFrame {
  Vec3 at, along;
};

Vec3 onAxis(double share) {
  double length = 0;
  for (std::size_t k = 1; k < stations.size(); ++k)
    length += (stations[k].at - stations[k - 1].at).norm();
  double left = share * length;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const Vec3 step = stations[k].at - stations[k - 1].at;
    if (left <= step.norm() || k + 1 == stations.size())
      return stations[k - 1].at + left / step.norm() * step;
    left -= step.norm();
  }
  return stations.back().at;
}

AxisFrame frameAt(double share) {
  constexpr double reach = 0.06;
  const double from = std::max(0.0, share - reach), to = std::min(1.0, share + reach);
  // straight at both ends
  return {onAxis(share), (onAxis(to) - onAxis(from)).normalized()};
}

// Rings around the axis of the empty stomach.
SurfaceMesh emptyStomach() {
  const LevelSet level = [](const Vec3& p) { return stomachLevel(p, 0); };
  constexpr int rings = 22;
  std::vector<double> weights(rings - 2, 1.0);
  std::vector<Index> counts = {16};
  for (const Index n : shareOut(512 - 16 - 17, weights)) counts.push_back(n);
  counts.push_back(17);
  SurfaceMesh mesh;
  const std::vector<Ring> all = makeRings(counts, 0, true);
  for (int k = 0; k < rings; ++k) {
    const AxisFrame frame = frameAt(static_cast<double>(k) / (rings - 1));
    const Vec3 u = Vec3::UnitY().cross(frame.along).normalized();
    const Vec3 v = u.cross(frame.along);  // the later ring is the outer one of a band
    for (Index i = 0; i < all[k].count; ++i) {
      const double angle = 2 * std::numbers::pi * turn(all[k], i);
      const Vec3 direction = std::cos(angle) * u + std::sin(angle) * v;
      mesh.positions.push_back(frame.at + castRay(level, frame.at, direction, 1.6) * direction);
    }
    if (k > 0) addBand(all[k - 1], all[k], mesh.triangles);
  }
  return mesh;
}

GroupedMesh inMetres(std::string comment, std::string group, SurfaceMesh mesh) {
  for (Vec3& p : mesh.positions) p *= centimetre;
  return {{std::move(comment)}, std::move(mesh.positions), {{std::move(group), mesh.triangles}}};
}

}  // namespace

GroupedMesh liver() {
  SurfaceMesh mesh = thrownSphere(liverLevel, {0.8, -0.8, 2.2}, 502, 20);
  relax(liverLevel, 400, mesh);
  return inMetres("Liver, closed: 502 nodes, 1000 triangles; metres", "liver", std::move(mesh));
}

GroupedMesh stomach() {
  SurfaceMesh mesh = emptyStomach();
  constexpr int fillingSteps = 100;
  for (int step = 0; step <= fillingSteps; ++step) {
    const double filling = static_cast<double>(step) / fillingSteps;
    relax([&](const Vec3& p) { return stomachLevel(p, filling); }, 5, mesh);
  }
  relax([](const Vec3& p) { return stomachLevel(p, 1); }, 300, mesh);
  return inMetres(
      "Stomach, open at oesophagus and duodenum: 512 nodes, 991 triangles, rims of 16 "
      "and 17 edges; metres",
      "stomach", std::move(mesh));
}

}  // namespace stroma::meshes
