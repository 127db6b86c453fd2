// SPDX-License-Identifier: Apache-2.0
#include "tests/components/cutting/test_bodies.h"

#include <cmath>
#include <numbers>

#include "components/io/mesh_file.h"

namespace stroma::test {
namespace {

// Unit cube of cells, each divided by Kuhn's six tetrahedra along its diagonal.
TetrahedralMesh unitGrid(std::array<int, 3> n) {
  TetrahedralMesh mesh;
  const auto id = [&](int i, int j, int k) { return (i * (n[1] + 1) + j) * (n[2] + 1) + k; };
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k)
        mesh.points.emplace_back(double(i) / n[0], double(j) / n[1], double(k) / n[2]);
  constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (const auto& axes : order) {
          std::array<int, 3> c = {i, j, k};
          Tetrahedron t;
          t[0] = id(c[0], c[1], c[2]);
          for (std::size_t s = 0; s < 3; ++s) {
            ++c[static_cast<std::size_t>(axes[s])];
            t[s + 1] = id(c[0], c[1], c[2]);
          }
          mesh.tetrahedra.push_back(t);
        }
  return mesh;
}

// Square [-1, 1]^2 onto the unit disk.
Eigen::Vector2d toDisk(double x, double y) {
  return {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2)};
}

}  // namespace

TetrahedralMesh block(const Vec3& size, std::array<int, 3> cells, double jitter, unsigned seed) {
  TetrahedralMesh mesh = unitGrid(cells);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  for (Vec3& x : mesh.points)
    for (int d = 0; d < 3; ++d) {
      const double move = shift(random) / cells[static_cast<std::size_t>(d)];
      if (x[d] > 1e-9 && x[d] < 1 - 1e-9) x[d] += move;
      x[d] *= size[d];
    }
  return mesh;
}

TetrahedralMesh shell(int across, int layers) {
  TetrahedralMesh mesh = unitGrid({across, across, layers});
  constexpr double radius = 7.8e-3, halfChord = 5.65e-3, thickness = 0.58e-3;
  const double widest = std::asin(halfChord / radius);
  for (Vec3& x : mesh.points) {
    const Eigen::Vector2d d = toDisk(2 * x.x() - 1, 2 * x.y() - 1);
    const double angle = widest * d.norm(), r = radius - thickness * (1 - x.z());
    const double ring = d.norm() > 0 ? r * std::sin(angle) / d.norm() : 0;
    x = {ring * d.x(), ring * d.y(), r * std::cos(angle) - radius};
  }
  return mesh;
}

TetrahedralMesh ball(double radius, int cells) {
  TetrahedralMesh mesh = unitGrid({cells, cells, cells});
  for (Vec3& p : mesh.points) {
    const Vec3 c = 2 * p - Vec3::Ones();
    const Vec3 q = c.cwiseProduct(c);
    p = radius * Vec3(c.x() * std::sqrt(1 - q.y() / 2 - q.z() / 2 + q.y() * q.z() / 3),
                      c.y() * std::sqrt(1 - q.z() / 2 - q.x() / 2 + q.z() * q.x() / 3),
                      c.z() * std::sqrt(1 - q.x() / 2 - q.y() / 2 + q.x() * q.y() / 3));
  }
  return mesh;
}

SimplicialComplex disk(double radius, int rings, double bend) {
  std::vector<Vec3> points = {Vec3::Zero()};
  std::vector<Triangle> triangles;
  for (int r = 1; r <= rings; ++r)
    for (int k = 0; k < 6 * r; ++k) {
      const double angle = 2 * std::numbers::pi * k / (6 * r);
      points.emplace_back(radius * r / rings * std::cos(angle),
                          radius * r / rings * std::sin(angle), 0.0);
    }
  const auto id = [](int r, int k) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + k % (6 * r); };
  for (int r = 1; r <= rings; ++r)
    for (int side = 0; side < 6; ++side)
      for (int k = 0; k < r; ++k) {
        const int outer = side * r + k, inner = side * (r - 1) + k;
        triangles.push_back({id(r - 1, inner), id(r, outer), id(r, outer + 1)});
        if (k + 1 < r)
          triangles.push_back({id(r - 1, inner), id(r, outer + 1), id(r - 1, inner + 1)});
      }
  if (bend > 0)
    for (Vec3& x : points) x.z() = std::sqrt(bend * bend - x.squaredNorm()) - bend;
  return SimplicialComplex::fromTriangles(points, triangles);
}

SimplicialComplex solid(const TetrahedralMesh& mesh) {
  return SimplicialComplex::fromTetrahedra(mesh.points, mesh.tetrahedra);
}

SimplicialComplex sceneSolid(const std::string& name) {
  const MeshData file =
      readMesh(std::filesystem::path(STROMA_MESHES) / (name + ".msh"), MeshFormat::gmsh);
  return SimplicialComplex::fromTetrahedra(file.positions, file.tetrahedra, file.triangles);
}

}  // namespace stroma::test
