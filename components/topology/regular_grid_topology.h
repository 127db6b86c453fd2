// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/topology/regular_grid.h"
#include "core/interfaces/mesh.h"

namespace stroma {

template <>
struct EnumNames<CellSplit> {
  static constexpr std::array<std::pair<CellSplit, std::string_view>, 3> names = {
      {{CellSplit::none, "none"}, {CellSplit::six, "six"}, {CellSplit::five, "five"}}};
};

// Points of a regular grid, numbered x fastest, then y, then z; the hexahedra between them; the
// outer surface as quads and triangles that face outwards; on demand each cell also as
// tetrahedra. Each point stands for an eighth of the
// cells around it, so the volumes add up to the box.
class RegularGridTopology final : public Topology {
 public:
  Attribute<std::array<Index, 3>> n{
      this, "n", {2, 2, 2}, "Number of points along x, y and z.", {.aliases = "resolution"}};
  Attribute<int> nx{this, "nx", 2, "Number of points along x, instead of n.", {.min = 1}};
  Attribute<int> ny{this, "ny", 2, "Number of points along y, instead of n.", {.min = 1}};
  Attribute<int> nz{this, "nz", 2, "Number of points along z, instead of n.", {.min = 1}};
  Attribute<Vec3> min{
      this, "min", Vec3::Zero(), "Corner with the smallest coordinates.", {.unit = "m"}};
  Attribute<Vec3> max{
      this, "max", Vec3::Ones(), "Corner with the largest coordinates.", {.unit = "m"}};
  Attribute<double> xmin{this, "xmin", 0.0, "x of min, instead of it.", {.unit = "m"}};
  Attribute<double> ymin{this, "ymin", 0.0, "y of min, instead of it.", {.unit = "m"}};
  Attribute<double> zmin{this, "zmin", 0.0, "z of min, instead of it.", {.unit = "m"}};
  Attribute<double> xmax{this, "xmax", 1.0, "x of max, instead of it.", {.unit = "m"}};
  Attribute<double> ymax{this, "ymax", 1.0, "y of max, instead of it.", {.unit = "m"}};
  Attribute<double> zmax{this, "zmax", 1.0, "z of max, instead of it.", {.unit = "m"}};
  Attribute<Vec3> p0{
      this, "p0", Vec3::Zero(), "First point, where cellWidth is given.", {.unit = "m"}};
  Attribute<double> cellWidth{this,
                              "cellWidth",
                              0.0,
                              "Distance of neighbours, instead of max.",
                              {.unit = "m", .min = 0, .exclusiveMin = true}};

  Attribute<CellSplit> createTetrahedra{
      this, "createTetrahedra", CellSplit::none,
      "Also splits each cell into tetrahedra: six, all cells alike, or five, neighbours mirrored "
      "(less stiff in bending)."};

  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Points.", {.unit = "m", .output = true, .autolink = true}};
  Attribute<std::vector<Edge>> edgeList{
      this, "edges", {}, "Edges of the cells.", {.output = true, .autolink = true}};
  Attribute<std::vector<Hexahedron>> hexahedronList{
      this, "hexahedra", {}, "The cells.", {.output = true, .autolink = true}};
  Attribute<std::vector<Tetrahedron>> tetrahedronList{
      this,
      "tetrahedra",
      {},
      "The cells' tetrahedra; src=\"@grid\" hands on the cells alone.",
      {.output = true}};
  Attribute<std::vector<Quad>> quadList{
      this, "quads", {}, "Outer surface.", {.output = true, .autolink = true}};
  Attribute<std::vector<Triangle>> triangleList{this,
                                                "triangles",
                                                {},
                                                "Outer surface, each quad in two.",
                                                {.output = true, .autolink = true}};
  Attribute<std::vector<double>> volume{this,
                                        "volume",
                                        {},
                                        "Volume that each point stands for.",
                                        {.unit = "m^3", .output = true, .autolink = true}};

  void bind() override;
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const Edge> edges() const override { return *edgeList; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return *triangleList; }
  [[nodiscard]] std::span<const Quad> quads() const override { return *quadList; }
  [[nodiscard]] std::span<const Hexahedron> hexahedra() const override { return *hexahedronList; }
  [[nodiscard]] std::span<const Tetrahedron> tetrahedra() const override {
    return *tetrahedronList;
  }
  [[nodiscard]] std::span<const double> volumes() const override { return *volume; }
};

}  // namespace stroma
