// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_invariants.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace stroma {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct HalfEdge {
  Edge edge;  // ascending
  bool forward;
  Index triangle;
  bool operator<(const HalfEdge& b) const {
    return edge != b.edge ? edge < b.edge : triangle < b.triangle;
  }
};

class Check {
 public:
  Check(const SimplicialComplex& complex, double volume) : complex_(complex), volume_(volume) {}

  SurfaceNumbers run() {
    Index count = 0;
    pieceOf_ = complex_.pieces(count);
    numbers_.pieces.resize(at(count));
    edges();
    fans();
    measure();
    shapes();
    walls();
    for (std::size_t p = 0; p < numbers_.pieces.size(); ++p) {
      const PieceNumbers& n = numbers_.pieces[p];
      expect(n.triangles == 2 * n.nodes - 2 * n.euler() - n.rimEdges,
             "piece " + std::to_string(p) + ": F != 2V - 2chi - B");
    }
    return std::move(numbers_);
  }

 private:
  void expect(bool good, const std::string& text) {
    constexpr std::size_t enough = 20;
    if (!good && numbers_.failures.size() < enough) numbers_.failures.push_back(text);
  }
  PieceNumbers& pieceAt(Index triangle) {
    return numbers_.pieces[at(pieceOf_[at(complex_.behind(triangle))])];
  }

  void edges() {
    std::vector<HalfEdge> half;
    const auto surface = complex_.surface();
    for (Index s = 0; s < static_cast<Index>(surface.size()); ++s) {
      const Triangle& t = surface[at(s)];
      ++pieceAt(s).triangles;
      numbers_.walls += complex_.isWall(s) ? 1 : 0;
      const SimplicialComplex::Simplex& behind = complex_.simplex(complex_.behind(s));
      for (const Index n : t)
        expect(std::find(behind.begin(), behind.end(), complex_.nodeVertex(n)) != behind.end(),
               "triangle " + std::to_string(s) + " is not on the simplex behind it");
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        half.push_back({{std::min(a, b), std::max(a, b)}, a < b, s});
      }
    }
    std::sort(half.begin(), half.end());
    for (std::size_t k = 0; k < half.size();) {
      std::size_t end = k;
      while (end < half.size() && half[end].edge == half[k].edge) ++end;
      const std::string name =
          "edge " + std::to_string(half[k].edge[0]) + "-" + std::to_string(half[k].edge[1]);
      PieceNumbers& piece = pieceAt(half[k].triangle);
      ++piece.edges;
      if (end - k == 1) ++piece.rimEdges;
      expect(end - k <= 2, name + " has " + std::to_string(end - k) + " triangles");
      expect(end - k != 1 || complex_.dimension() == 2, name + " has one triangle");
      expect(end - k != 2 || half[k].forward != half[k + 1].forward,
             name + " is used twice in the same direction");
      k = end;
    }
  }

  // A node has one fan if its triangles hang together across edges at the node.
  void fans() {
    const auto surface = complex_.surface();
    std::vector<std::vector<Index>> around(at(complex_.nodeCount()));
    for (Index s = 0; s < static_cast<Index>(surface.size()); ++s)
      for (const Index n : surface[at(s)]) around[at(n)].push_back(s);
    std::vector<Index> group;
    for (Index n = 0; n < complex_.nodeCount(); ++n) {
      const auto& triangles = around[at(n)];
      if (triangles.empty()) continue;
      ++pieceAt(triangles[0]).nodes;
      group.assign(1, triangles[0]);
      for (std::size_t k = 0; k < group.size(); ++k)
        for (const Index s : triangles) {
          if (std::find(group.begin(), group.end(), s) != group.end()) continue;
          int shared = 0;
          for (const Index a : surface[at(s)])
            for (const Index b : surface[at(group[k])]) shared += a == b ? 1 : 0;
          if (shared >= 2) group.push_back(s);
        }
      expect(group.size() == triangles.size(), "node " + std::to_string(n) + " has two fans");
    }
  }

  void measure() {
    Vec3 sum = Vec3::Zero(), origin = Vec3::Zero();
    double enclosed = 0;
    if (complex_.nodeCount() > 0) origin = complex_.nodePosition(0);
    for (const Triangle& t : complex_.surface()) {
      const Vec3 a = complex_.nodePosition(t[0]) - origin, b = complex_.nodePosition(t[1]) - origin,
                 c = complex_.nodePosition(t[2]) - origin;
      const Vec3 area = (b - a).cross(c - a) / 2;
      sum += area;
      numbers_.area += area.norm();
      enclosed += a.dot(b.cross(c)) / 6;
    }
    if (complex_.dimension() == 2) return;
    numbers_.volume = enclosed;
    numbers_.openness = sum.norm() / numbers_.area;
    double simplices = 0;
    for (Index t = 0; t < complex_.simplexCount(); ++t) {
      const auto& s = complex_.simplex(t);
      const Vec3& a = complex_.vertex(s[0]);
      const double v = (complex_.vertex(s[1]) - a)
                           .cross(complex_.vertex(s[2]) - a)
                           .dot(complex_.vertex(s[3]) - a) /
                       6;
      expect(v > 0, "tetrahedron " + std::to_string(t) + " is turned inside out");
      simplices += v;
    }
    constexpr double tolerance = 1e-12;
    numbers_.volumeMismatch = std::abs(enclosed - simplices) / simplices;
    expect(numbers_.openness <= tolerance, "the surface is not closed");
    expect(numbers_.volumeMismatch <= tolerance, "surface and simplices differ in volume");
    if (volume_ > 0)
      expect(std::abs(enclosed - volume_) <= tolerance * volume_, "the volume has changed");
  }

  void shapes() {
    constexpr double sliver = 5, flat = 1e-9;
    const auto surface = complex_.surface();
    std::vector<Triangle> keys;
    double edgeSum = 0, lowest = 1e300, smallest = 180;
    Index slivers = 0;
    for (Triangle t : surface) {
      std::array<double, 3> length;
      for (std::size_t i = 0; i < 3; ++i) {
        length[i] = (complex_.nodePosition(t[i]) - complex_.nodePosition(t[(i + 1) % 3])).norm();
        edgeSum += length[i];
      }
      const Vec3 u = complex_.nodePosition(t[1]) - complex_.nodePosition(t[0]),
                 w = complex_.nodePosition(t[2]) - complex_.nodePosition(t[0]);
      const double doubleArea = u.cross(w).norm();
      std::sort(length.begin(), length.end());
      lowest = std::min(lowest, doubleArea / length[2]);
      // the smallest angle is opposite the shortest side
      const double sine = std::min(1.0, doubleArea / (length[1] * length[2]));
      const double angle = std::asin(sine) * 180 / std::numbers::pi;
      smallest = std::min(smallest, angle);
      slivers += angle < sliver ? 1 : 0;
      std::sort(t.begin(), t.end());
      keys.push_back(t);
    }
    numbers_.smallestAngle = smallest;
    numbers_.sliverFraction = static_cast<double>(slivers) / static_cast<double>(surface.size());
    numbers_.smallestTriangle = lowest / (edgeSum / (3.0 * static_cast<double>(surface.size())));
    expect(numbers_.smallestTriangle > flat, "a triangle has no height");
    std::sort(keys.begin(), keys.end());
    expect(std::adjacent_find(keys.begin(), keys.end()) == keys.end(),
           "two triangles on the same nodes");
  }

  void walls() {
    if (complex_.dimension() == 2) return;
    std::vector<std::array<Vec3, 3>> sides;
    const auto lexicographic = [](const Vec3& a, const Vec3& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    for (Index s = 0; s < static_cast<Index>(complex_.surface().size()); ++s) {
      if (!complex_.isWall(s)) continue;
      const Triangle& t = complex_.surface()[at(s)];
      sides.push_back(
          {complex_.nodePosition(t[0]), complex_.nodePosition(t[1]), complex_.nodePosition(t[2])});
      std::sort(sides.back().begin(), sides.back().end(), lexicographic);
    }
    std::sort(sides.begin(), sides.end(), [&](const auto& a, const auto& b) {
      return std::lexicographical_compare(a[0].data(), a[0].data() + 3, b[0].data(),
                                          b[0].data() + 3) ||
             (a[0] == b[0] &&
              (lexicographic(a[1], b[1]) || (a[1] == b[1] && lexicographic(a[2], b[2]))));
    });
    bool paired = sides.size() % 2 == 0;
    for (std::size_t k = 0; paired && k < sides.size(); k += 2) paired = sides[k] == sides[k + 1];
    expect(paired, "the two walls of a cut do not coincide");
  }

  const SimplicialComplex& complex_;
  double volume_;
  std::vector<Index> pieceOf_;
  SurfaceNumbers numbers_;
};

}  // namespace

Index SurfaceNumbers::euler() const {
  Index sum = 0;
  for (const PieceNumbers& p : pieces) sum += p.euler();
  return sum;
}

SurfaceNumbers checkInvariants(const SimplicialComplex& complex, double volume) {
  return Check(complex, volume).run();
}

std::uint64_t topologyHash(const SimplicialComplex& complex) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 1099511628211ULL;
  };
  for (Index v = 0; v < complex.vertexCount(); ++v)
    add(complex.vertex(v).data(), 3 * sizeof(double));
  for (Index t = 0; t < complex.simplexCount(); ++t) {
    add(&complex.simplex(t), sizeof(SimplicialComplex::Simplex));
    for (int i = 0; i < complex.corners(); ++i) {
      const char free = complex.isFree({t, i}) ? 1 : 0;
      add(&free, 1);
    }
  }
  for (const Triangle& t : complex.surface()) add(&t, sizeof t);
  return hash;
}

}  // namespace stroma
