// SPDX-License-Identifier: Apache-2.0
// Reads meshes from files: surfaces through the assimp library, Gmsh's solids without it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "components/io/obj_records.h"
#include "core/types.h"

namespace stroma {

enum class MeshFormat { obj, stl, ply, gmsh };

// A named part of a mesh: a group or object of an OBJ file, a solid of an STL file.
struct MeshGroup {
  std::string name;
  std::vector<Index> triangles;  // ascending
};

struct MeshData {
  std::vector<Vec3> positions;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Tetrahedron> tetrahedra;  // positive: the last point is in front of the others
  std::vector<Vec3> normals;            // one a point or none; corners that differ are averaged
  std::vector<Vec3> texcoords;          // one a point or none; the first corner's
  std::vector<MeshGroup> groups;
  std::vector<MeshProblem> problems;  // why there is no mesh; empty when there is one
};

// Points and faces are those of the file, in its order: N `v` records of an OBJ file give N points,
// with all digits, N vertices of a PLY file N points. STL files name no points: equal
// positions are one point, numbered as they first occur. Coordinates of PLY and STL files come
// in single precision. Convex quads and polygons are split into
// triangles unless told otherwise. See gmsh_file.h for Gmsh files.
// Never throws and never reads files of more than 2 GB.
[[nodiscard]] MeshData readMesh(const std::filesystem::path& file, MeshFormat format,
                                bool triangulate = true);
// The same from the file's bytes.
[[nodiscard]] MeshData parseMesh(std::string_view bytes, MeshFormat format,
                                 bool triangulate = true);

}  // namespace stroma
