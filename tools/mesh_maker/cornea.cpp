// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/cornea.h"

#include <cmath>
#include <numbers>

#include "tools/mesh_maker/rings.h"

namespace stroma::meshes {
namespace {

constexpr double radius = 7.8e-3;  // of the anterior surface

struct Outline {
  double halfWidth, halfHeight;
};
constexpr Outline corneaOutline{5.9e-3, 5.4e-3};
constexpr Outline capOutline{5.65e-3, 5.65e-3};

// Direction from the centre of curvature to the point at share `rho` of the arc from apex to rim.
Vec3 direction(const Outline& outline, double rho, double turnShare) {
  const double angle = 2 * std::numbers::pi * turnShare;
  const double x = outline.halfWidth * std::cos(angle), y = outline.halfHeight * std::sin(angle);
  const double chord = std::sqrt(x * x + y * y);
  const double polar = rho * std::asin(chord / radius);
  const double sine = std::sin(polar) / chord;
  return {x * sine, y * sine, std::cos(polar)};
}

Vec3 atDepth(const Vec3& outwards, double depth) {
  return (radius - depth) * outwards - Vec3(0, 0, radius);
}

struct Disk {
  std::vector<Ring> rings;
  std::vector<double> rho;  // of each ring
  std::vector<Triangle> triangles;
};

// Node 0 in the middle, then the rings.
Disk makeDisk(const std::vector<Index>& counts, const std::vector<double>& rho, bool staggered) {
  Disk disk{makeRings(counts, 1, staggered), rho, {}};
  addFan(0, disk.rings.front(), disk.triangles);
  for (std::size_t k = 1; k < disk.rings.size(); ++k)
    addBand(disk.rings[k - 1], disk.rings[k], disk.triangles);
  return disk;
}

// One side of a cornea, thickness t(rho) below the anterior surface.
template <class Thickness>
std::vector<Vec3> placeDisk(const Disk& disk, const Outline& outline, Thickness&& depth) {
  std::vector<Vec3> x{atDepth(Vec3::UnitZ(), depth(0.0))};
  for (std::size_t k = 0; k < disk.rings.size(); ++k)
    for (Index i = 0; i < disk.rings[k].count; ++i)
      x.push_back(
          atDepth(direction(outline, disk.rho[k], turn(disk.rings[k], i)), depth(disk.rho[k])));
  return x;
}

// Rings of 6, 12, 18... nodes.
Disk hexagonalDisk(int rings) {
  std::vector<Index> counts;
  std::vector<double> rho;
  for (int k = 1; k <= rings; ++k) {
    counts.push_back(6 * k);
    rho.push_back(static_cast<double>(k) / rings);
  }
  return makeDisk(counts, rho, false);
}

template <class Thickness>
GroupedMesh makeShell(int rings, const Outline& outline, Thickness&& thickness) {
  const Disk disk = hexagonalDisk(rings);
  GroupedMesh mesh;
  mesh.positions = placeDisk(disk, outline, [](double) { return 0.0; });
  const std::vector<Vec3> posterior = placeDisk(disk, outline, thickness);
  const auto below = static_cast<Index>(posterior.size());
  mesh.positions.insert(mesh.positions.end(), posterior.begin(), posterior.end());

  mesh.groups = {{"anterior", disk.triangles}, {"posterior", {}}, {"rim", {}}};
  for (const Triangle& t : disk.triangles)
    mesh.groups[1].triangles.push_back({t[0] + below, t[2] + below, t[1] + below});
  const Ring& outer = disk.rings.back();
  std::vector<std::vector<Index>> wall(1);
  for (Index i = 0; i < outer.count; ++i) {
    const Index a = outer.first + i, b = outer.first + (i + 1) % outer.count;
    mesh.groups[2].triangles.push_back({a, a + below, b + below});
    mesh.groups[2].triangles.push_back({a, b + below, b});
    wall[0].insert(wall[0].end(), {a, a + below});
  }
  mesh.comments.push_back("groups: anterior, posterior, rim (the wall between them)");
  mesh.comments.push_back(
      "the nodes of the rim, and no others, lie in these boxes (BoxROI, metres):");
  mesh.comments.push_back("box=\"" + boxesAround(wall, mesh.positions) + "\"");
  return mesh;
}

}  // namespace

GroupedMesh corneaSheet() {
  const std::vector<Index> counts = {6, 11, 16, 20, 24, 27, 27, 28, 32};
  // bands as high as equilateral triangles on their outer ring would be
  std::vector<double> rho = {1.0};
  for (std::size_t k = 1; k < counts.size(); ++k)
    rho.push_back(rho.back() / (1 - std::sqrt(3.0) * std::numbers::pi / counts[k]));
  const double outermost = rho.back();
  for (double& r : rho) r /= outermost;
  const Disk disk = makeDisk(counts, rho, true);
  return {{"Cornea, anterior surface: 192 nodes, 350 triangles, 32 rim edges; metres"},
          placeDisk(disk, corneaOutline, [](double) { return 0.0; }),
          {{"anterior", disk.triangles}}};
}

GroupedMesh corneaShell(int rings) {
  GroupedMesh mesh =
      makeShell(rings, corneaOutline, [](double rho) { return 0.58e-3 + 0.06e-3 * rho * rho; });
  mesh.comments.insert(mesh.comments.begin(),
                       "Cornea, closed: 0.58 mm thick in the middle, 0.64 mm at the rim; metres");
  return mesh;
}

GroupedMesh corneaCap(int rings) {
  GroupedMesh mesh = makeShell(rings, capOutline, [](double) { return 0.58e-3; });
  mesh.comments.insert(mesh.comments.begin(),
                       "Corneal cap, closed: anterior radius 7.8 mm, half-chord 5.65 mm, uniformly "
                       "0.58 mm thick; metres");
  return mesh;
}

}  // namespace stroma::meshes
