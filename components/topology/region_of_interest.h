// SPDX-License-Identifier: Apache-2.0
// Selections by place: their `indices` tell constraints, forces and monitors what to act on.
#pragma once

#include "components/topology/region.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// What the regions have in common. Points are `position`, else the rest positions of the nearest
// state, else the points of the node's topology; elements those given, else the topology's. An
// element is in with all its points (strict), or with at least one (not strict).
class RegionOfInterest : public Component {
 public:
  static constexpr std::string_view role = "RegionOfInterest";

  Attribute<std::vector<Vec3>> position{
      this,
      "position",
      {},
      "Points to choose from; the state's rest positions if not given.",
      {.unit = "m", .autolink = true, .aliases = "rest_position points"}};
  Attribute<std::vector<Edge>> edges{
      this, "edges", {}, "Edges to choose from; the topology's if not given.", {.autolink = true}};
  Attribute<std::vector<Triangle>> triangles{
      this,
      "triangles",
      {},
      "Triangles to choose from; the topology's if not given.",
      {.autolink = true}};
  Attribute<std::vector<Tetrahedron>> tetrahedra{
      this,
      "tetrahedra",
      {},
      "Tetrahedra to choose from; the topology's if not given.",
      {.autolink = true, .aliases = "tetras"}};
  Attribute<bool> strict{this, "strict", true,
                         "Whether an element is in with all its points, or with any of them."};
  Link<MechanicalState> mechanicalState{this,
                                        "state",
                                        "Particles to choose from.",
                                        Lookup::nearest,
                                        {.required = false, .aliases = "mstate"}};
  Link<Topology> topology{
      this, "topology", "Elements to choose from.", Lookup::sameNode, {.required = false}};

  Attribute<IndexList> indices{this, "indices", {}, "Points inside, ascending.", {.output = true}};
  Attribute<std::vector<Vec3>> pointsInROI{
      this, "pointsInROI", {}, "Where these points are.", {.unit = "m", .output = true}};
  Attribute<IndexList> edgeIndices{this, "edgeIndices", {}, "Edges inside.", {.output = true}};
  Attribute<IndexList> triangleIndices{
      this, "triangleIndices", {}, "Triangles inside.", {.output = true}};
  Attribute<IndexList> tetrahedronIndices{
      this, "tetrahedronIndices", {}, "Tetrahedra inside.", {.output = true}};

  void bind() override;

 protected:
  // Whether the region can be used; reports what is wrong with it.
  [[nodiscard]] virtual bool prepare() = 0;
  [[nodiscard]] virtual bool isInside(const Vec3& point) const = 0;

 private:
  [[nodiscard]] ConstVec3Span points() const;
};

// Points in any of several boxes.
class BoxRoi final : public RegionOfInterest {
 public:
  Attribute<std::vector<Box>> box{
      this, "box", {}, "Boxes, each \"xmin ymin zmin xmax ymax zmax\".", {.unit = "m"}};
  Attribute<std::vector<double>> orientedBox{
      this,
      "orientedBox",
      {},
      "Turned boxes, ten numbers each: three corners p0 p1 p2 of the middle face and the depth "
      "across it.",
      {.unit = "m"}};

 protected:
  [[nodiscard]] bool prepare() override;
  [[nodiscard]] bool isInside(const Vec3& point) const override;

 private:
  std::vector<OrientedBox> turned_;
};

// Points in any of several balls.
class SphereRoi final : public RegionOfInterest {
 public:
  Attribute<std::vector<Vec3>> centers{
      this, "centers", {}, "Centres of the balls.", {.unit = "m", .required = true}};
  Attribute<std::vector<double>> radii{this,
                                       "radii",
                                       {},
                                       "Their radii; one value holds for all.",
                                       {.unit = "m", .min = 0, .required = true}};

 protected:
  [[nodiscard]] bool prepare() override;
  [[nodiscard]] bool isInside(const Vec3& point) const override;
};

}  // namespace stroma
