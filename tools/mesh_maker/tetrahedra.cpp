// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/tetrahedra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "components/sampling/surface_check.h"
#include "components/sampling/surface_closing.h"

namespace nglib {
#include <netgen/nglib.h>
}

namespace stroma::meshes {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The files of this tool: `v` and triangular `f` records.
void readObj(const std::filesystem::path& path, TetrahedralMesh& mesh) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const auto refuse = [&](const char* why) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + why + ": " +
                               line);
    };
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3 x;
      if (!(words >> x[0] >> x[1] >> x[2])) refuse("expected three coordinates");
      mesh.positions.push_back(x);
    } else if (kind == "f") {
      Triangle t;
      std::string rest;
      for (Index& v : t) {
        if (!(words >> v) || v < 1) refuse("expected the numbers of three vertices");
        --v;
        if (words.peek() == '/') words >> rest;  // texture and normal are of no use here
      }
      if (words >> rest) refuse("expected a triangle");
      mesh.surface.push_back(t);
    }
  }
}

// An open sheet gets lids, as where particles fill it.
void closeRims(TetrahedralMesh& mesh) {
  if (!whyNotSheet(mesh.positions, mesh.surface).empty() || boundaryLoops(mesh.surface).empty())
    return;
  SurfaceMesh closed = capRims(mesh.positions, mesh.surface);
  mesh.positions = std::move(closed.positions);
  mesh.surface = std::move(closed.triangles);
}

void requireClosed(const TetrahedralMesh& mesh) {
  std::vector<Edge> forward, backward;
  for (const Triangle& t : mesh.surface)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < 0 || at(t[i]) >= mesh.positions.size())
        throw std::runtime_error("a triangle names node " + std::to_string(t[i] + 1));
      forward.push_back({t[i], t[(i + 1) % 3]});
      backward.push_back({t[(i + 1) % 3], t[i]});
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  if (forward != backward || std::adjacent_find(forward.begin(), forward.end()) != forward.end())
    throw std::runtime_error("the surface is not closed");
}

double meanEdge(const TetrahedralMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.surface)
    for (std::size_t i = 0; i < 3; ++i)
      sum += (mesh.positions[at(t[i])] - mesh.positions[at(t[(i + 1) % 3])]).norm();
  return sum / (3.0 * static_cast<double>(mesh.surface.size()));
}

double toNanometre(double x) { return std::round(x * 1e9) * 1e-9; }

double smallestDihedral(const TetrahedralMesh& mesh) {
  double smallest = std::numbers::pi;
  for (const Tetrahedron& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        // dihedral angle at the edge ij, between the other two corners
        std::array<Vec3, 2> other;
        const Vec3 a = mesh.positions[at(t[i])];
        const Vec3 axis = (mesh.positions[at(t[j])] - a).normalized();
        for (std::size_t k = 0, n = 0; k < 4; ++k) {
          if (k == i || k == j) continue;
          const Vec3 arm = mesh.positions[at(t[k])] - a;
          other[n++] = arm - arm.dot(axis) * axis;
        }
        smallest =
            std::min(smallest, std::atan2(other[0].cross(other[1]).norm(), other[0].dot(other[1])));
      }
  return smallest * 180 / std::numbers::pi;
}

// While it lives, what the library tells on standard output goes nowhere.
class Quiet {
 public:
  Quiet() : before_(std::cout.rdbuf(nullptr)) {}
  ~Quiet() { std::cout.rdbuf(before_), std::cout.clear(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::streambuf* before_;
};

void requireVolumes(const TetrahedralMesh& mesh) {
  for (const Tetrahedron& t : mesh.tetrahedra) {
    const Vec3& a = mesh.positions[at(t[0])];
    const Vec3 b = mesh.positions[at(t[1])] - a, c = mesh.positions[at(t[2])] - a,
               d = mesh.positions[at(t[3])] - a;
    if (!(b.cross(c).dot(d) > 0)) throw std::runtime_error("netgen made a flat tetrahedron");
  }
}

}  // namespace

TetrahedralMesh fillSurface(const std::filesystem::path& obj, double size) {
  TetrahedralMesh mesh;
  readObj(obj, mesh);
  closeRims(mesh);
  requireClosed(mesh);
  const std::size_t nodes = mesh.positions.size();
  // netgen's tolerances want lengths of about one
  const double scale = meanEdge(mesh);

  const Quiet quiet;
  nglib::Ng_Init();
  nglib::Ng_Mesh* filled = nglib::Ng_NewMesh();
  for (const Vec3& x : mesh.positions) {
    Vec3 scaled = x / scale;
    nglib::Ng_AddPoint(filled, scaled.data());
  }
  for (const Triangle& t : mesh.surface) {
    std::array<int, 3> corners = {t[0] + 1, t[1] + 1, t[2] + 1};
    nglib::Ng_AddSurfaceElement(filled, nglib::NG_TRIG, corners.data());
  }
  nglib::Ng_Meshing_Parameters parameters;
  if (size > 0) parameters.maxh = size;
  const auto result = nglib::Ng_GenerateVolumeMesh(filled, &parameters);
  const int points = nglib::Ng_GetNP(filled), elements = nglib::Ng_GetNE(filled);
  for (int p = static_cast<int>(nodes) + 1; p <= points; ++p) {
    Vec3 x;
    nglib::Ng_GetPoint(filled, p, x.data());
    mesh.positions.push_back((scale * x).unaryExpr(&toNanometre));
  }
  for (int e = 1; e <= elements; ++e) {
    std::array<int, 10> corners{};
    nglib::Ng_GetVolumeElement(filled, e, corners.data());
    // netgen counts the corners the other way round
    mesh.tetrahedra.push_back({corners[0] - 1, corners[2] - 1, corners[1] - 1, corners[3] - 1});
  }
  nglib::Ng_DeleteMesh(filled);
  nglib::Ng_Exit();
  if (result != nglib::NG_OK || elements == 0)
    throw std::runtime_error("netgen cannot fill " + obj.string());
  requireVolumes(mesh);
  mesh.smallestDihedral = smallestDihedral(mesh);
  return mesh;
}

void writeMsh(const TetrahedralMesh& mesh, std::ostream& out) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.positions.size() << '\n';
  out << std::fixed << std::setprecision(9);
  std::size_t number = 0;
  for (const Vec3& x : mesh.positions)
    out << ++number << ' ' << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  out << "$EndNodes\n$Elements\n" << mesh.surface.size() + mesh.tetrahedra.size() << '\n';
  number = 0;
  constexpr int triangle = 2, tetrahedron = 4;
  const auto element = [&](int kind, const auto& corners) {
    out << ++number << ' ' << kind << " 0";
    for (const Index v : corners) out << ' ' << v + 1;
    out << '\n';
  };
  for (const Triangle& t : mesh.surface) element(triangle, t);
  for (const Tetrahedron& t : mesh.tetrahedra) element(tetrahedron, t);
  out << "$EndElements\n";
}

}  // namespace stroma::meshes
