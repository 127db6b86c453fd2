// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/io/mesh_check.h"
#include "components/io/mesh_file.h"
#include "core/interfaces/mesh.h"

namespace stroma {

// A mesh from a file, scaled, rotated about x, then y, then z (R = Rz Ry Rx) and shifted.
// Coordinates in the file are metres unless `scale` says otherwise (0.001 for a mesh in
// millimetres). Files that give no mesh, bad indices and coordinates that are not finite are
// errors; triangles without area, edges with three triangles or with two that face opposite ways,
// points without a face and sizes that no tissue has are warnings, the first four only when nobody
// refused the mesh for them. Tetrahedra, which Gmsh files have, stay positively oriented when
// the mesh is reflected or its normals are flipped.
class MeshLoader : public Mesh {
 public:
  Attribute<FilePath> filename{this, "filename", {}, "The mesh file.", {.required = true}};
  Attribute<Vec3> translation{
      this, "translation", Vec3::Zero(), "Shift, applied last.", {.unit = "m"}};
  Attribute<Vec3> rotation{this, "rotation", Vec3::Zero(),
                           "Rotation about x, then y, then z, in degrees."};
  Attribute<double> scale{
      this, "scale", 1.0, "Scaling, applied first.", {.min = 0, .exclusiveMin = true}};
  Attribute<Vec3> scale3d{this, "scale3d", Vec3::Ones(), "Scaling along each axis, times scale."};
  Attribute<bool> flipNormals{this, "flipNormals", false, "Turns every face over."};
  Attribute<int> subdivisions{
      this,
      "subdivisions",
      0,
      "How often every triangle is split into four: loads on a surface want "
      "triangles no larger than the particles' spacing.",
      {.min = 0, .max = 8}};
  Attribute<bool> triangulate{this, "triangulate", true,
                              "Splits quads and polygons into triangles."};

  Attribute<std::vector<Vec3>> position{this,
                                        "position",
                                        {},
                                        "Points, in the order of the file.",
                                        {.unit = "m", .output = true, .autolink = true}};
  Attribute<std::vector<Edge>> edgeList{
      this, "edges", {}, "Lines of the file.", {.output = true, .autolink = true}};
  Attribute<std::vector<Triangle>> triangleList{this,
                                                "triangles",
                                                {},
                                                "Triangles, in the order of the file.",
                                                {.output = true, .autolink = true}};
  Attribute<std::vector<Quad>> quadList{this,
                                        "quads",
                                        {},
                                        "Quads, where they are not triangulated.",
                                        {.output = true, .autolink = true}};
  Attribute<std::vector<Tetrahedron>> tetrahedronList{
      this,
      "tetrahedra",
      {},
      "Tetrahedra, in the order of the file.",
      {.output = true, .autolink = true, .aliases = "tetras"}};
  Attribute<std::vector<Vec3>> normals{this,
                                       "normals",
                                       {},
                                       "Unit normals of the points, where the file has them.",
                                       {.output = true, .autolink = true}};
  Attribute<std::vector<Vec3>> texcoords{this,
                                         "texcoords",
                                         {},
                                         "Texture coordinates u v 0, where the file has them.",
                                         {.output = true, .autolink = true}};
  Attribute<std::vector<std::string>> groupNames{
      this,
      "groups",
      {},
      "Names of the file's groups; MeshGroupROI selects one.",
      {.output = true}};

  void bind() override;
  void start() override;
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const Edge> edges() const override { return *edgeList; }
  [[nodiscard]] std::span<const Triangle> triangles() const override { return *triangleList; }
  [[nodiscard]] std::span<const Quad> quads() const override { return *quadList; }
  [[nodiscard]] std::span<const Tetrahedron> tetrahedra() const override {
    return *tetrahedronList;
  }
  [[nodiscard]] std::span<const MeshGroup> groups() const { return groups_; }

 protected:
  explicit MeshLoader(MeshFormat format) : format_(format) {}

 private:
  void transform(MeshData& mesh) const;
  void publish(MeshData mesh);
  MeshFormat format_;
  std::vector<MeshGroup> groups_;
  std::vector<MeshRemark> blemishes_;
};

template <MeshFormat format>
class MeshFileLoader final : public MeshLoader {
 public:
  MeshFileLoader() : MeshLoader(format) {}
};

}  // namespace stroma
