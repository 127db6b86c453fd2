// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/io/mesh_loader.h"

namespace stroma {

// The points and triangles of named groups of a mesh file, such as the rim of a cornea. `strict`
// leaves out points that triangles of other groups use, too.
class MeshGroupRoi final : public Component {
 public:
  static constexpr std::string_view role = "RegionOfInterest";

  Attribute<std::vector<std::string>> group{
      this, "group", {}, "Names of the groups.", {.required = true}};
  Attribute<bool> strict{this, "strict", false, "Leaves out points that other groups share."};
  Link<MeshLoader> loader{
      this, "loader", "The loader of the mesh.", Lookup::nearest, {.aliases = "mesh"}};

  Attribute<IndexList> indices{this, "indices", {}, "Points, ascending.", {.output = true}};
  Attribute<IndexList> triangleIndices{
      this, "triangleIndices", {}, "Triangles, ascending.", {.output = true}};
  Attribute<std::vector<Triangle>> triangles{
      this, "triangles", {}, "The triangles themselves.", {.output = true, .autolink = true}};

  void bind() override;
};

}  // namespace stroma
