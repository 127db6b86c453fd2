// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_file.h"

#include <gtest/gtest.h>

#include <random>

#include "components/io/mesh_check.h"
#include "components/io/surface_file.h"

namespace stroma {
namespace {

const char* tetrahedron =
    "v 0 0 0\nv 0.1234567890123 0 0\nv 0 1 0\nv 0 0 1\n"
    "vn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 0\n"
    "g base\nf 1/1/1 3/2/1 2/1/1\n"
    "g sides\nf 1/1/2 2/2/2 4/1/2\nf 2/2/1 3/1/1 4/1/2\nf 3/1/1 1/1/1 4/2/2\n";

std::vector<Vec3> cloud(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-0.01, 0.01);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(unit(random), unit(random), unit(random));
  }
  return points;
}

// Triangles in an order that does not name points as they come.
std::vector<Triangle> shuffledFan(int count) {
  std::vector<Triangle> triangles;
  for (Index i = count - 1; i >= 2; i -= 2) triangles.push_back({i, i - 2, i - 1});
  return triangles;
}

TEST(ObjFile, keepsPointsOrderAndDigitsInSpiteOfSeams) {
  const MeshData mesh = parseMesh(tetrahedron, MeshFormat::obj);
  ASSERT_TRUE(mesh.problems.empty()) << mesh.problems.front().message;
  ASSERT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.positions[1].x(), 0.1234567890123);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.triangles[3], (Triangle{2, 0, 3}));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].name, "base");
  EXPECT_EQ(mesh.groups[1].triangles, (std::vector<Index>{1, 2, 3}));
  EXPECT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.texcoords.size(), 4u);
}

TEST(ObjFile, keepsPointsInTheSamePlaceApart) {
  const MeshData mesh = parseMesh(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n", MeshFormat::obj);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.triangles[1], (Triangle{3, 5, 4}));
}

TEST(ObjFile, keepsUnusedPointsAndReadsNegativeIndices) {
  const MeshData mesh =
      parseMesh("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", MeshFormat::obj);
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles.at(0), (Triangle{1, 2, 3}));
  const auto remarks = checkMesh(mesh);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].id, "mesh-unused");
}

TEST(ObjFile, splitsQuadsAndPolygonsOnlyWhenAsked) {
  const char* text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const MeshData split = parseMesh(text, MeshFormat::obj),
                 whole = parseMesh(text, MeshFormat::obj, false);
  EXPECT_EQ(split.triangles.size(), 2u);
  ASSERT_EQ(whole.quads.size(), 1u);
  EXPECT_EQ(whole.quads[0], (Quad{0, 1, 2, 3}));
}

TEST(ObjFile, groupsAndMaterialsInterleavedKeepTheFacesOrder) {
  std::string text;
  const auto points = cloud(60);
  for (const Vec3& x : points) {
    text += "v " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " " +
            std::to_string(x.z()) + "\n";
  }
  const auto triangles = shuffledFan(60);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i % 3 == 0) text += i % 2 ? "g a\n" : "g b\n";
    if (i % 4 == 0) text += i % 8 ? "usemtl red\n" : "usemtl blue\n";
    text += "f " + std::to_string(triangles[i][0] + 1) + " " + std::to_string(triangles[i][1] + 1) +
            " " + std::to_string(triangles[i][2] + 1) + "\n";
  }
  const MeshData mesh = parseMesh(text, MeshFormat::obj);
  ASSERT_TRUE(mesh.problems.empty()) << mesh.problems.front().message;
  EXPECT_EQ(mesh.positions.size(), 60u);
  EXPECT_EQ(mesh.triangles, triangles);
}

TEST(SurfaceFile, comesBackWithTheSamePointsAndTriangles) {
  const auto points = cloud(201);
  const auto triangles = shuffledFan(201);
  const MeshData obj =
      parseMesh(surfaceFile(SurfaceFormat::obj, points, triangles), MeshFormat::obj);
  EXPECT_EQ(obj.positions, points);
  EXPECT_EQ(obj.triangles, triangles);
  const MeshData ply =
      parseMesh(surfaceFile(SurfaceFormat::ply, points, triangles), MeshFormat::ply);
  ASSERT_EQ(ply.positions.size(), points.size());
  EXPECT_EQ(ply.triangles, triangles);
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    worst = std::max(worst, (ply.positions[i] - points[i]).norm() / 0.01);
  }
  std::printf("PLY: relative rounding %.2e\n", worst);
  EXPECT_LT(worst, 1.2e-7);
  const MeshData stl =
      parseMesh(surfaceFile(SurfaceFormat::stl, points, triangles), MeshFormat::stl);
  EXPECT_EQ(stl.positions.size(), points.size());
  ASSERT_EQ(stl.triangles.size(), triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = stl.positions[static_cast<std::size_t>(stl.triangles[t][i])];
      EXPECT_LT((x - points[static_cast<std::size_t>(triangles[t][i])]).norm(), 2e-9);
    }
  }
}

struct Broken {
  const char* name;
  MeshFormat format;
  std::string text;
  const char* expected;  // part of the problem's or remark's text
  int line;
};

TEST(BrokenMesh, isExplainedAndNeverCrashes) {
  const std::string point = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  const std::string facet = "solid s\nfacet normal 0 0 1\nouter loop\n";
  const std::vector<Broken> meshes{
      {"empty", MeshFormat::obj, "", "the file is empty", 0},
      {"no faces", MeshFormat::obj, point, "no", 0},
      {"letter in a number", MeshFormat::obj, "v 0 0 0\nv 1 O 0\n", "is not a number", 2},
      {"not a number", MeshFormat::obj, "v 0 0 nan\n" + point + "f 2 3 4\n", "not finite", 1},
      {"two coordinates", MeshFormat::obj, "v 0 0\n", "fewer than three", 1},
      {"index too large", MeshFormat::obj, point + "f 1 2 4\n", "index 4 names no point", 4},
      {"index zero", MeshFormat::obj, point + "f 0 1 2\n", "index 0 names no point", 4},
      {"index far back", MeshFormat::obj, point + "f -4 1 2\n", "index -4 names no point", 4},
      {"index no number", MeshFormat::obj, point + "f 1 2 x\n", "is no index", 4},
      {"missing normal", MeshFormat::obj, point + "f 1//1 2//1 3//1\n", "names no normal", 4},
      {"face of two", MeshFormat::obj, point + "f 1 2\n", "has 2 points", 4},
      {"huge index", MeshFormat::obj, point + "f 1 2 99999999999999999999\n", "is no index", 4},
      {"binary noise", MeshFormat::ply, std::string(500, '\x7f'), "not understood", 1},
      {"huge promise", MeshFormat::ply,
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n",
       "ends after 1 of 4000000000", 0},
      {"cut header", MeshFormat::ply, "ply\nformat ascii 1.0\nelement vertex 3\n", "no end", 0},
      {"index out of range", MeshFormat::ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
       "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
       "0\n0 1 0\n3 0 1 7\n",
       "uses point 7", 0},
      {"nothing per element", MeshFormat::ply,
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n", "no properties", 0},
      {"letter in text", MeshFormat::ply, points + "0 0 0\n1 O 0\n0 1 0\n", "'O' is not a number",
       9},
      {"short line", MeshFormat::ply, points + "0 0 0\n1 0\n0 1 0\n", "too few numbers", 9},
      {"long line", MeshFormat::ply, points + "0 0 0 0\n1 0\n0 1 0\n", "too many numbers", 8},
      {"cut text", MeshFormat::ply, points + "0 0 0\n1 0 0\n", "ends after 2 of 3 elements", 0},
      {"cut binary", MeshFormat::stl, std::string(80, ' ') + std::string("\x05\0\0\0", 4),
       "has 334 bytes, this one 84", 0},
      {"no solid", MeshFormat::stl, "solid nothing\nendsolid\n", "no triangles", 0},
      {"letter", MeshFormat::stl, facet + "vertex 0 0 O\n", "'O' is not a number", 4},
      {"two vertices", MeshFormat::stl, facet + "vertex 0 0 0\nvertex 1 0 0\nendloop\n",
       "expected 'vertex', got 'endloop'", 6},
      {"cut facet", MeshFormat::stl, facet + "vertex 0 0 0\n", "ends inside a facet", 0},
      {"no end", MeshFormat::stl,
       facet + "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
       "without 'endsolid'", 0},
      {"bytes in a text", MeshFormat::stl, facet + std::string("vertex 0\0 0 0\n", 14),
       "no STL file", 0},
      {"letter to the editor", MeshFormat::stl, "dear sir\n", "no STL file", 0},
  };
  for (const Broken& broken : meshes) {
    const MeshData mesh = parseMesh(broken.text, broken.format);
    std::string found;
    int line = 0;
    if (!mesh.problems.empty()) {
      found = mesh.problems.front().message;
      line = mesh.problems.front().line;
    } else {
      const auto remarks = checkMesh(mesh);
      ASSERT_FALSE(remarks.empty()) << broken.name;
      EXPECT_TRUE(remarks.front().unusable) << broken.name;
      found = remarks.front().message;
    }
    EXPECT_NE(found.find(broken.expected), std::string::npos) << broken.name << ": " << found;
    EXPECT_EQ(line, broken.line) << broken.name << ": " << found;
    std::printf("%-20s %s\n", broken.name, found.c_str());
  }
}

TEST(OddMesh, isRemarkedOnce) {
  const auto remarksOf = [](const char* text) {
    return checkMesh(parseMesh(text, MeshFormat::obj));
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 2 0 0\n";
  const auto first = [&](const std::string& faces) {
    const auto remarks = remarksOf((points + faces).c_str());
    return remarks.empty() ? std::string() : remarks.front().id;
  };
  EXPECT_EQ(first("f 1 2 3\nf 1 2 4\nf 2 1 5\nf 3 4 6\n"), "mesh-nonmanifold");
  EXPECT_EQ(first("f 1 2 6\nf 3 4 5\n"), "mesh-degenerate");
  EXPECT_EQ(first("f 1 1 6\nf 3 4 5\n"), "mesh-degenerate");
  EXPECT_EQ(first("f 1 2 3\nf 1 2 4\nf 4 5 6\n"), "mesh-orientation");
}

}  // namespace
}  // namespace stroma
