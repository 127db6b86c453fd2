// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/random_body.h"

#include <algorithm>
#include <map>

namespace stroma::fuzz {
namespace {

// An octahedron, each of whose triangles is divided into four so many times.
Surface ball(int divisions) {
  Surface s;
  s.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int d = 0; d < divisions; ++d) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [found, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<Index>(s.points.size()));
      if (isNew) {
        const auto at = [&](Index i) { return s.points[static_cast<std::size_t>(i)]; };
        s.points.push_back((at(a) + at(b)).normalized());
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = std::move(finer);
  }
  return s;
}

// What meshes of others may have: triangles twice, without area, holes, points that lie on others.
void spoil(Dice& dice, Surface& s) {
  const auto triangle = [&] {
    return static_cast<std::size_t>(dice.whole(0, static_cast<int>(s.triangles.size()) - 1));
  };
  const auto point = [&] {
    return static_cast<std::size_t>(dice.whole(0, static_cast<int>(s.points.size()) - 1));
  };
  switch (dice.whole(0, 4)) {
    case 0:
      s.triangles.push_back(s.triangles[triangle()]);
      break;
    case 1:
      s.triangles.erase(s.triangles.begin() + static_cast<std::ptrdiff_t>(triangle()));
      break;
    case 2:
      s.points[point()] = s.points[point()];
      break;
    case 3:
      std::swap(s.triangles[triangle()][0], s.triangles[triangle()][1]);
      break;
    default:
      s.points[point()] *= 5;
      break;
  }
}

Element meshOf(const Surface& s, const std::string& name) {
  return {"MeshTopology",
          {{"name", name}, {"position", textOf(s.points)}, {"triangles", textOf(s.triangles)}},
          {}};
}

class BodyMaker {
 public:
  BodyMaker(Dice& dice, bool odd) : dice_(dice), odd_(odd) {
    body_.length = odd && dice.chance(0.3) ? dice.decades(1e-9, 1e6) : dice.decades(2e-3, 0.5);
  }

  RandomBody make() {
    const double kind = dice_.uniform(0, 1);
    if (kind < 0.35) {
      grid();
    } else if (kind < 0.45) {
      lattice();
    } else if (kind < 0.7) {
      volume();
    } else if (kind < 0.8) {
      shell();
    } else if (kind < 0.88) {
      organ();
    } else {
      cloud();
    }
    return std::move(body_);
  }

 private:
  [[nodiscard]] Vec3 sides(Vec3& counts) {
    for (double& c : counts) c = dice_.whole(odd_ && dice_.chance(0.2) ? 1 : 2, 6);
    return body_.length * counts / counts.maxCoeff();
  }

  void addPoints(Element points) {
    body_.elements.push_back(std::move(points));
    body_.elements.push_back({"MechanicalObject", {{"name", "state"}}, {}});
  }

  void grid() {
    Vec3 n;
    const Vec3 side = sides(n);
    body_.particles = static_cast<int>(n.prod());
    const std::string tetrahedra = dice_.oneOf({"five", "six", "five", "none"});
    addPoints({"RegularGridTopology",
               {{"name", "points"},
                {"n", textOf(n)},
                {"min", "0 0 0"},
                {"max", textOf(side)},
                {"createTetrahedra", tetrahedra}},
               {}});
    body_.hasElements = true;
    body_.surface = "@/body/points";
    body_.canBeCut = tetrahedra != "none";
    if (body_.canBeCut) body_.solid = "@/body/points";
  }

  void lattice() {
    Vec3 n;
    const Vec3 side = sides(n);
    body_.particles = static_cast<int>(n.prod());
    addPoints({"ParticleSampler",
               {{"name", "points"},
                {"layout", "lattice"},
                {"n", textOf(n)},
                {"max", textOf(side)},
                {"jitter", textOf(dice_.chance(0.5) ? 0 : dice_.uniform(0, 0.45))}},
               {}});
  }

  void volume() {
    Surface blob = randomBlob(dice_, body_.length);
    if (odd_ && dice_.chance(0.4)) spoil(dice_, blob);
    body_.low = Vec3::Constant(-0.5 * body_.length);
    body_.particles = dice_.whole(odd_ ? 1 : 20, 150);
    body_.surface = "@/body/skin";
    inNodeOfItsOwn(meshOf(blob, "skin"));
    addPoints({"ParticleSampler",
               {{"name", "points"},
                {"surface", "@/body/skins/skin"},
                {"count", std::to_string(body_.particles)},
                {"seed", std::to_string(dice_.whole(0, 99))}},
               {}});
    body_.surface = "@/body/skins/skin";
    body_.particles = std::max(1, body_.particles / 2);
  }

  void shell() {
    Surface sheet = randomSheet(dice_, body_.length);
    body_.canBeCut = true;
    if (odd_ && dice_.chance(0.4)) spoil(dice_, sheet);
    body_.low = Vec3(-0.5, -0.5, -0.2) * body_.length;
    body_.particles = dice_.whole(odd_ ? 1 : 40, 200);
    inNodeOfItsOwn(meshOf(sheet, "skin"));
    addPoints({"ParticleSampler",
               {{"name", "points"},
                {"layout", "shell"},
                {"surface", "@/body/skins/skin"},
                {"thickness", textOf(body_.length * dice_.uniform(0.03, 0.2))},
                {"layers", std::to_string(dice_.whole(1, 4))},
                {"count", std::to_string(body_.particles)}},
               {}});
    body_.surface = "@/body/skins/skin";
    body_.particles = std::max(1, body_.particles / 2);
  }

  // One of the shipped meshes, filled with tetrahedra: coarse clouds in fine surfaces.
  void organ() {
    const bool cornea = dice_.chance(0.5);
    const std::string name = cornea ? "cornea_shell" : "liver";
    body_.length = cornea ? 0.0113 : 0.2;
    body_.low = cornea ? Vec3(-0.0056, -0.0056, -0.0035) : Vec3(-0.1, -0.07, -0.05);
    body_.particles = dice_.whole(60, 150);
    Element loader{"MeshOBJLoader", {{"name", "skin"}, {"filename", name + ".obj"}}, {}};
    Element solid{"MeshGmshLoader", {{"name", "solid"}, {"filename", name + ".msh"}}, {}};
    body_.elements = {loader, solid};
    addPoints({"ParticleSampler",
               {{"name", "points"},
                {"surface", "@skin"},
                {"count", std::to_string(body_.particles)},
                {"layout", cornea ? "shell" : "volume"}},
               {}});
    body_.surface = "@/body/skin";
    body_.solid = "@/body/solid";
    body_.canBeCut = true;
    body_.particles = std::max(1, body_.particles / 2);
  }

  void cloud() {
    const int kind = dice_.whole(0, odd_ ? 6 : 1);
    const int count = odd_ && dice_.chance(0.3) ? dice_.whole(1, 3) : dice_.whole(4, 120);
    const Vec3 along = dice_.vector(-1, 1), across = dice_.vector(-1, 1);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const Vec3 free = dice_.vector(0, 1);
      if (kind == 2) points.push_back(along * free.x());                      // a row
      if (kind == 3) points.push_back(along * free.x() + across * free.y());  // a layer
      if (kind == 4 && i % 3 == 2)
        points.push_back(points[static_cast<std::size_t>(i - 1)]);  // duplicates
      if (kind == 5) points.push_back(Vec3(free.x(), 1e-9 * free.y(), 1e-12 * free.z()));
      if (kind == 6) points.push_back(free * dice_.decades(1e-6, 1));
      if (points.size() <= static_cast<std::size_t>(i)) points.push_back(free);
    }
    for (Vec3& p : points) p *= body_.length;
    body_.particles = count;
    body_.elements.push_back(
        {"MechanicalObject", {{"name", "state"}, {"position", textOf(points)}}, {}});
  }

  // A topology would be the body's own, were it in the same node.
  void inNodeOfItsOwn(Element mesh) {
    body_.elements.push_back({"Node", {{"name", "skins"}}, {std::move(mesh)}});
  }

  Dice& dice_;
  bool odd_;
  RandomBody body_;
};

}  // namespace

Surface randomBlob(Dice& dice, double length) {
  Surface s = ball(dice.whole(1, 3));
  const Vec3 stretch = dice.vector(0.3, 1);
  const double dents = dice.uniform(0, 0.3);
  for (Vec3& p : s.points)
    p = 0.5 * length * (1 - dents * dice.uniform(0, 1)) * stretch.cwiseProduct(p);
  return s;
}

Surface randomSheet(Dice& dice, double length) {
  const int nx = dice.whole(3, 8), ny = dice.whole(3, 8);
  const double height = dice.uniform(0, 0.1), dome = dice.uniform(0, 0.5);
  Surface s;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const double x = i / (nx - 1.0) - 0.5, y = j / (ny - 1.0) - 0.5;
      s.points.push_back(length *
                         Vec3(x, y, height * dice.uniform(0, 0.3) - dome * (x * x + y * y)));
    }
  }
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const Index a = j * nx + i, b = a + 1, c = a + nx, d = c + 1;
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, c});
    }
  }
  return s;
}

RandomBody randomBody(Dice& dice, bool odd) { return BodyMaker(dice, odd).make(); }

}  // namespace stroma::fuzz
