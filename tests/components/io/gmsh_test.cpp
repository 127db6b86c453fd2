// SPDX-License-Identifier: Apache-2.0
#include "components/io/gmsh_file.h"
#include "core/interfaces/mesh.h"
#include "core/scene.h"
#include "tests/components/io/scratch_folder.h"

namespace stroma {
namespace {

const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

// Two tetrahedra on the triangle 0-1-2, the second one written inside out; numbers with gaps.
const std::string twoTetrahedra = format +
                                  "$PhysicalNames\n1\n3 1 \"solid\"\n$EndPhysicalNames\n"
                                  "$Nodes\n5\n"
                                  "10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n7 0.25 0.25 -1\n"
                                  "$EndNodes\n"
                                  "$Elements\n5\n"
                                  "1 15 2 0 1 10\n"
                                  "2 1 2 0 1 10 20\n"
                                  "3 2 2 0 1 20 30 40\n"
                                  "4 4 2 0 1 10 20 30 40\n"
                                  "5 4 0 10 20 30 7\n"
                                  "$EndElements\n";

double volume6(ConstVec3Span x, const Tetrahedron& t) {
  const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(t[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
}

TEST(Gmsh, keepsTheOrderOfTheFileAndTurnsTetrahedra) {
  const MeshData mesh = parseGmsh(twoTetrahedra);
  ASSERT_TRUE(mesh.problems.empty()) << mesh.problems[0].message;
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.positions[4], Vec3(0.25, 0.25, -1));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{1, 2, 3}}));
  EXPECT_EQ(mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 4, 2}}));
  for (const Tetrahedron& t : mesh.tetrahedra) EXPECT_GT(volume6(mesh.positions, t), 0);
}

TEST(Gmsh, shippedSolidsAreReadWhole) {
  for (const std::string name : {"cornea_shell", "liver"}) {
    const MeshData mesh =
        readMesh(std::string(STROMA_MESHES) + "/" + name + ".msh", MeshFormat::gmsh);
    ASSERT_TRUE(mesh.problems.empty()) << mesh.problems[0].message;
    const MeshData surface =
        readMesh(std::string(STROMA_MESHES) + "/" + name + ".obj", MeshFormat::obj);
    EXPECT_EQ(mesh.triangles, surface.triangles) << "the surface comes first, in its order";
    double inside = 0, enclosed = 0, least = 1;
    for (const Tetrahedron& t : mesh.tetrahedra) {
      inside += volume6(mesh.positions, t) / 6;
      least = std::min(least, volume6(mesh.positions, t) / 6);
    }
    for (const Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
      enclosed += at(0).dot(at(1).cross(at(2))) / 6;
    }
    std::printf("%s: %zu points, %zu triangles, %zu tetrahedra, volume differs by %.1e\n",
                name.c_str(), mesh.positions.size(), mesh.triangles.size(), mesh.tetrahedra.size(),
                std::abs(inside / enclosed - 1));
    EXPECT_GT(least, 0);
    EXPECT_NEAR(inside / enclosed, 1, 1e-12);
  }
}

struct Broken {
  const char* what;
  std::string text;
  int line;
  std::string message;
};

TEST(Gmsh, brokenFilesAreNamedWithTheirLine) {
  const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
  const std::string four = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n";
  const auto elements = [](const std::string& one) {
    return "$Elements\n1\n" + one + "\n$EndElements\n";
  };
  const std::vector<Broken> files = {
      {"other format", "solid x\n", 1, "does not begin with $MeshFormat"},
      {"version 4", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", 2, "only format 2 is read"},
      {"binary", "$MeshFormat\n2.2 1 8\n", 2, "only ASCII"},
      {"no end of format", "$MeshFormat\n2.2 0 8\n", 3, "expected $EndMeshFormat"},
      {"no nodes", format + "$Elements\n0\n$EndElements\n", 0, "no section $Nodes"},
      {"no elements", format + nodes, 0, "no section $Elements"},
      {"between sections", format + "1 2 3\n", 4, "belongs to no section"},
      {"bad count", format + "$Nodes\nmany\n", 5, "number of entries"},
      {"negative count", format + "$Nodes\n-1\n", 5, "number of entries"},
      {"too many promised", format + "$Nodes\n3\n1 0 0 0\n$EndNodes\n", 7, "1 of 3 entries"},
      {"cut short", format + "$Nodes\n3\n1 0 0 0\n", 7, "1 of 3 entries"},
      {"too few promised", format + "$Nodes\n1\n1 0 0 0\n2 1 0 0\n$EndNodes\n", 7,
       "expected $EndNodes after 1 entries"},
      {"letter", format + "$Nodes\n1\n1 0 x 0\n$EndNodes\n", 6, "'x' is not a number"},
      {"not finite", format + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", 6, "'nan' is not finite"},
      {"two coordinates", format + "$Nodes\n1\n1 0 0\n$EndNodes\n", 6, "too few numbers"},
      {"four coordinates", format + "$Nodes\n1\n1 0 0 0 0\n$EndNodes\n", 6, "too many numbers"},
      {"node twice", format + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", 7, "node 1 occurs twice"},
      {"no such node", format + nodes + elements("1 2 0 1 2 9"), 12, "names node 9"},
      {"two corners", format + nodes + elements("1 2 0 1 2"), 12, "too few numbers"},
      {"five corners", format + nodes + elements("1 2 0 1 2 3 1"), 12, "too many numbers"},
      {"missing tags", format + nodes + elements("1 2 9 1 2 3"), 12, "too few numbers"},
      {"hexahedron", format + nodes + elements("1 5 0 1 2 3 1 2 3 1 2"), 12, "of kind 5"},
      {"flat", format + four + elements("7 4 0 1 2 3 4"), 13, "tetrahedron 7 has no volume"},
      {"node twice in one", format + four + elements("7 4 0 1 2 3 3"), 13, "no volume"},
      {"open section", format + "$PhysicalNames\n1\n", 4, "has no end"}};
  for (const Broken& file : files) {
    const MeshData mesh = parseGmsh(file.text);
    ASSERT_EQ(mesh.problems.size(), 1u) << file.what;
    EXPECT_EQ(mesh.problems[0].line, file.line) << file.what << ": " << mesh.problems[0].message;
    EXPECT_NE(mesh.problems[0].message.find(file.message), std::string::npos)
        << file.what << ": " << mesh.problems[0].message;
  }
}

TEST(Gmsh, everyBeginningOfAFileIsAProblemOrAMesh) {
  for (std::size_t size = 0; size + 1 < twoTetrahedra.size(); ++size) {
    const MeshData mesh = parseMesh(twoTetrahedra.substr(0, size), MeshFormat::gmsh);
    EXPECT_EQ(mesh.problems.size(), 1u) << size;
  }
}

class GmshLoader : public ScratchFolder {
 protected:
  const Mesh& load(const std::string& attributes) {
    write("a.msh", twoTetrahedra);
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    scene_ = std::make_unique<Scene>(options);
    if (scene_->loadText("<Node name=\"root\"><MeshGmshLoader name='mesh' filename='a.msh' " +
                             attributes + "/><MeshTopology name='topology' src='@mesh'/></Node>",
                         folder_ / "test.xml")) {
      (void)scene_->initialise();
    }
    return dynamic_cast<const Mesh&>(*scene_->root().components().back());
  }
  std::unique_ptr<Scene> scene_;
};

TEST_F(GmshLoader, givesATopologyPointsTrianglesAndTetrahedra) {
  const Mesh& mesh = load("scale='0.001' translation='0 0 1'");
  ASSERT_EQ(mesh.tetrahedra().size(), 2u) << scene_->diagnostics().text();
  EXPECT_EQ(mesh.triangles().size(), 1u);
  EXPECT_LT((mesh.positions()[4] - Vec3(0.00025, 0.00025, 0.999)).norm(), 1e-15);
}

TEST_F(GmshLoader, reflectionsAndFlipsLeaveTetrahedraPositive) {
  for (const char* attributes :
       {"", "scale3d='-1 1 1'", "flipNormals='1'", "flipNormals='1' scale3d='1 1 -2'"}) {
    const Mesh& mesh = load(attributes);
    ASSERT_EQ(mesh.tetrahedra().size(), 2u) << scene_->diagnostics().text();
    for (const Tetrahedron& t : mesh.tetrahedra()) EXPECT_GT(volume6(mesh.positions(), t), 0);
    // outside is away from the origin, unless it is flipped
    const Triangle& t = mesh.triangles()[0];
    const auto at = [&](std::size_t k) { return mesh.positions()[static_cast<std::size_t>(t[k])]; };
    const double outwards = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(0));
    EXPECT_EQ(outwards > 0, std::string(attributes).find("flip") == std::string::npos);
  }
}

TEST_F(GmshLoader, solidsAreNotSubdivided) {
  load("subdivisions='1'");
  EXPECT_NE(scene_->diagnostics().text().find("[attr-conflict]"), std::string::npos)
      << scene_->diagnostics().text();
}

}  // namespace
}  // namespace stroma
