// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mesh.h"
#include "core/topology_change.h"

namespace stroma {

// Points and elements given by the scene, mostly by src="@loader". Every element must name existing
// points, each once. With tetrahedra or hexahedra, each point stands for a quarter or an eighth of
// those around it.
//
// When a body is cut whose surface this is, points and triangles follow; the attributes keep what
// the scene gave, and spans of that stay valid. Other elements are not divided: a topology that has
// been cut has none.
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

  Attribute<std::vector<Vec3>> texcoords{
      this,
      "texcoords",
      {},
      "Texture coordinates (u, v, 0) of the points. Points that a cut makes on an edge lie between "
      "its ends; those inside the body have the coordinates 0 0.",
      {.autolink = true}};

  void bind() override;
  [[nodiscard]] bool followsCuts() const override { return true; }
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  [[nodiscard]] ConstVec3Span positions() const override {
    return cut_ ? ConstVec3Span(cutPositions_) : ConstVec3Span(*position);
  }
  [[nodiscard]] std::span<const Triangle> triangles() const override {
    return cut_ ? std::span<const Triangle>(cutTriangles_) : *triangleList;
  }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }
  [[nodiscard]] std::span<const char> incisionWalls() const override { return cutWalls_; }
  [[nodiscard]] ConstVec3Span textureCoordinates() const override {
    return cut_ ? ConstVec3Span(cutTexture_) : ConstVec3Span(*texcoords);
  }
  [[nodiscard]] std::span<const Edge> edges() const override { return uncut(edgeList); }
  [[nodiscard]] std::span<const Quad> quads() const override { return uncut(quadList); }
  [[nodiscard]] std::span<const Tetrahedron> tetrahedra() const override {
    return uncut(tetrahedronList);
  }
  [[nodiscard]] std::span<const Hexahedron> hexahedra() const override {
    return uncut(hexahedronList);
  }
  [[nodiscard]] std::span<const double> volumes() const override {
    return cut_ ? std::span<const double>() : volumes_;
  }

 private:
  [[nodiscard]] Vec3 textureOf(const NewSurfaceNode& node) const;
  template <class Element>
  [[nodiscard]] std::span<const Element> uncut(const Attribute<std::vector<Element>>& list) const {
    return cut_ ? std::span<const Element>() : *list;
  }
  std::vector<double> volumes_;
  bool cut_ = false;
  std::uint64_t revision_ = 0;
  std::vector<Vec3> cutPositions_, cutTexture_;  // once it has been cut
  std::vector<char> cutWalls_;
  std::vector<Triangle> cutTriangles_;
};

}  // namespace stroma
