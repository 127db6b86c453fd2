// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_file.h"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <fstream>
#include <map>

#include "components/io/file_check.h"
#include "components/io/gmsh_file.h"
#include "core/diagnostics.h"

namespace stroma {
namespace {

constexpr std::uintmax_t mostBytes = 2'000'000'000;

const char* extension(MeshFormat format) {
  constexpr std::array names{"obj", "stl", "ply", "msh"};
  return names[static_cast<std::size_t>(format)];
}

Vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

// The meshes in the order of the file, with the name of the group that each belongs to.
struct Part {
  const aiMesh* mesh;
  std::string group;
};

void collectParts(const aiScene& scene, const aiNode& node, std::vector<Part>& parts) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    parts.push_back({scene.mMeshes[node.mMeshes[i]], node.mName.C_Str()});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    collectParts(scene, *node.mChildren[i], parts);
  }
}

// Point of each vertex of all parts: equal positions are one point, numbered as they first occur.
std::vector<Index> weld(const std::vector<Part>& parts, std::vector<Vec3>& positions) {
  std::map<std::array<double, 3>, Index> known;
  std::vector<Index> points;
  for (const Part& part : parts) {
    for (unsigned v = 0; v < part.mesh->mNumVertices; ++v) {
      const Vec3 x = vec(part.mesh->mVertices[v]);
      if (!x.allFinite()) {  // has no order, and is reported later
        points.push_back(static_cast<Index>(positions.size()));
        positions.push_back(x);
        continue;
      }
      const auto [at, fresh] = known.try_emplace({x.x() + 0.0, x.y() + 0.0, x.z() + 0.0},
                                                 static_cast<Index>(positions.size()));
      if (fresh) positions.push_back(x);
      points.push_back(at->second);
    }
  }
  return points;
}

std::vector<Index> keep(const std::vector<Part>& parts, std::vector<Vec3>& positions) {
  std::vector<Index> points;
  for (const Part& part : parts) {
    for (unsigned v = 0; v < part.mesh->mNumVertices; ++v) {
      points.push_back(static_cast<Index>(positions.size()));
      positions.push_back(vec(part.mesh->mVertices[v]));
    }
  }
  return points;
}

// The file's own points, when the vertices are the corners of its faces one after the other.
bool isCornerByCorner(const std::vector<Part>& parts, const ObjRecords& records) {
  std::size_t corner = 0;
  for (const Part& part : parts) {
    for (unsigned v = 0; v < part.mesh->mNumVertices; ++v, ++corner) {
      if (corner >= records.corners.size()) return false;
      const Vec3& x = records.points[static_cast<std::size_t>(records.corners[corner])];
      if ((vec(part.mesh->mVertices[v]) - x).norm() > 1e-5 * x.norm()) return false;
    }
  }
  return corner == records.corners.size();
}

MeshGroup& groupNamed(MeshData& data, const std::string& name) {
  const auto at = std::ranges::find(data.groups, name, &MeshGroup::name);
  return at != data.groups.end() ? *at : data.groups.emplace_back(MeshGroup{name, {}});
}

// Polygons become fans round their first corner; the library's own splitting asserts on odd faces.
void addFaces(const Part& part, std::span<const Index> points, bool triangulate, MeshData& data) {
  MeshGroup& group = groupNamed(data, part.group);
  for (unsigned f = 0; f < part.mesh->mNumFaces; ++f) {
    const aiFace& face = part.mesh->mFaces[f];
    std::array<Index, 4> node{};
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] >= part.mesh->mNumVertices) {
        data.problems.push_back(
            {"face " + std::to_string(f) + " uses point " + std::to_string(face.mIndices[i]) +
             " (counted from 0); there are " + std::to_string(part.mesh->mNumVertices)});
        return;
      }
      if (i < 4) node[i] = points[face.mIndices[i]];
    }
    if (triangulate && face.mNumIndices > 3) {
      for (unsigned i = 2; i < face.mNumIndices; ++i) {
        group.triangles.push_back(static_cast<Index>(data.triangles.size()));
        data.triangles.push_back({node[0], points[face.mIndices[i - 1]], points[face.mIndices[i]]});
      }
      continue;
    }
    switch (face.mNumIndices) {
      case 0:
      case 1:
        break;
      case 2:
        data.edges.push_back({node[0], node[1]});
        break;
      case 3:
        group.triangles.push_back(static_cast<Index>(data.triangles.size()));
        data.triangles.push_back({node[0], node[1], node[2]});
        break;
      case 4:
        data.quads.push_back(node);
        break;
      default:
        data.problems.push_back({"face " + std::to_string(f) + " has " +
                                 std::to_string(face.mNumIndices) +
                                 " corners: only triangulate=\"true\" can take it"});
        return;
    }
  }
}

void addVertexData(const std::vector<Part>& parts, std::span<const Index> points, MeshData& data) {
  const auto all = [&](auto&& has) { return std::ranges::all_of(parts, has); };
  if (all([](const Part& p) { return p.mesh->HasNormals(); })) {
    data.normals.assign(data.positions.size(), Vec3::Zero());
  }
  if (all([](const Part& p) { return p.mesh->HasTextureCoords(0); })) {
    data.texcoords.assign(data.positions.size(), Vec3::Zero());
  }
  std::vector<bool> seen(data.positions.size(), false);
  std::size_t vertex = 0;
  for (const Part& part : parts) {
    for (unsigned v = 0; v < part.mesh->mNumVertices; ++v, ++vertex) {
      const auto point = static_cast<std::size_t>(points[vertex]);
      if (!data.normals.empty()) data.normals[point] += vec(part.mesh->mNormals[v]);
      if (!data.texcoords.empty() && !seen[point]) {
        data.texcoords[point] = vec(part.mesh->mTextureCoords[0][v]);
      }
      seen[point] = true;
    }
  }
  for (Vec3& n : data.normals) n.normalize();
}

void convert(const aiScene& scene, MeshFormat format, const ObjRecords& records, bool triangulate,
             MeshData& data) {
  std::vector<Part> parts;
  if (scene.mRootNode) collectParts(scene, *scene.mRootNode, parts);
  std::vector<Index> points;
  if (format == MeshFormat::obj && isCornerByCorner(parts, records)) {
    data.positions = records.points;
    points = records.corners;
  } else if (format == MeshFormat::ply) {
    points = keep(parts, data.positions);
  } else {
    points = weld(parts, data.positions);
  }
  std::size_t first = 0;
  for (const Part& part : parts) {
    addFaces(part, std::span(points).subspan(first, part.mesh->mNumVertices), triangulate, data);
    first += part.mesh->mNumVertices;
  }
  addVertexData(parts, points, data);
  // the library's names for faces that the file puts into no group
  std::erase_if(data.groups, [](const MeshGroup& g) {
    return g.triangles.empty() || g.name.empty() || g.name == "defaultobject" ||
           g.name == "<STL_BINARY>";
  });
}

// The library's words, without the name it gives to bytes in memory.
std::string reason(std::string text) {
  text = text.substr(0, text.find('\n'));
  const std::size_t name = text.find("$$$___magic___$$$");
  return "not read: " + stroma::quoted(text.substr(0, name), 200);
}

}  // namespace

MeshData parseMesh(std::string_view bytes, MeshFormat format, bool triangulate) {
  MeshData data;
  ObjRecords records;
  if (bytes.empty()) {
    data.problems.push_back({"the file is empty"});
    return data;
  }
  if (format == MeshFormat::gmsh) return parseGmsh(bytes);
  if (format == MeshFormat::obj) {
    records = scanObj(bytes);
    data.problems = records.problems;
  } else if (auto problem = format == MeshFormat::ply ? plyProblem(bytes) : stlProblem(bytes)) {
    data.problems.push_back(std::move(*problem));
  }
  if (!data.problems.empty()) return data;
  try {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0U, extension(format));
    if (!scene) {
      data.problems.push_back({reason(importer.GetErrorString())});
    } else {
      convert(*scene, format, records, triangulate, data);
    }
  } catch (const std::exception& failure) {
    data.problems.push_back({reason(failure.what())});
  }
  return data;
}

MeshData readMesh(const std::filesystem::path& file, MeshFormat format, bool triangulate) {
  MeshData data;
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  std::ifstream stream(file, std::ios::binary);
  if (failure || !stream) {
    data.problems.push_back({"the file cannot be read"});
    return data;
  }
  if (size > mostBytes) {
    data.problems.push_back({"the file has more than 2 GB"});
    return data;
  }
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    data.problems.push_back({"the file cannot be read"});
    return data;
  }
  return parseMesh(bytes, format, triangulate);
}

}  // namespace stroma
