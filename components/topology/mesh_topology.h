// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mesh.h"

namespace stroma {

// Points and elements given by the scene, mostly by src="@loader". Every element must name existing
// points, each once. With tetrahedra, each point stands for a quarter of those around it.
class MeshTopology final : public Topology {
 public:
  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Points.", {.unit = "m", .autolink = true, .aliases = "points"}};
  Attribute<std::vector<Edge>> edgeList{
      this, "edges", {}, "Pairs of points.", {.autolink = true, .aliases = "lines"}};
  Attribute<std::vector<Triangle>> triangleList{
      this,
      "triangles",
      {},
      "Triples of points, counter-clockwise seen from outside.",
      {.autolink = true}};
  Attribute<std::vector<Quad>> quadList{this,
                                        "quads",
                                        {},
                                        "Fours of points, counter-clockwise seen from outside.",
                                        {.autolink = true}};
  Attribute<std::vector<Tetrahedron>> tetrahedronList{
      this, "tetrahedra", {}, "Fours of points.", {.autolink = true, .aliases = "tetras"}};
  Attribute<std::vector<Hexahedron>> hexahedronList{
      this,
      "hexahedra",
      {},
      "Eights of points: one face in turn, then the opposite one.",
      {.autolink = true, .aliases = "hexas"}};

  void bind() override;
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const Edge> edges() const override { return *edgeList; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return *triangleList; }
  [[nodiscard]] std::span<const Quad> quads() const override { return *quadList; }
  [[nodiscard]] std::span<const Tetrahedron> tetrahedra() const override {
    return *tetrahedronList;
  }
  [[nodiscard]] std::span<const Hexahedron> hexahedra() const override { return *hexahedronList; }
  [[nodiscard]] std::span<const double> volumes() const override { return volumes_; }

 private:
  std::vector<double> volumes_;
};

}  // namespace stroma
