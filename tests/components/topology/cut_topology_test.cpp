// SPDX-License-Identifier: Apache-2.0
#include "components/topology/mesh_topology.h"
#include "tests/components/solver/test_scene.h"
#include "tests/components/topology/hand_made_cut.h"

namespace stroma::test {
namespace {

Loaded square() {
  SceneOptions options;
  options.pluginFolders.clear();
  Loaded loaded{std::make_unique<Scene>(options), false};
  registerAll(loaded.scene->registry());
  loaded.scene->registry().add<MeshTopology>("MeshTopology");
  loaded.scene->registry().add<Riding>("Riding");
  loaded.ready = loaded.scene->loadText(dtNode(0.01, squareScene("")), "test.xml") &&
                 loaded.scene->initialise();
  EXPECT_TRUE(loaded.ready) << loaded.text();
  return loaded;
}

double area(const Topology& mesh, std::size_t count) {
  double sum = 0;
  for (std::size_t t = 0; t < count; ++t) {
    sum += 0.5 * cornersOf(mesh.triangles()[t], mesh.positions()).areaNormal().z();
  }
  return sum;
}

TEST(MeshTopology, followsACutAndIsWholeAgain) {
  const Loaded s = square();
  auto& mesh = s.find<MeshTopology>();
  const std::span<const Triangle> before = mesh.triangles();
  const std::vector<Triangle> whole(before.begin(), before.end());
  cutSquare(*s.scene);
  EXPECT_TRUE(std::ranges::equal(mesh.triangles(), cutTriangles));
  ASSERT_EQ(mesh.positions().size(), 10u);
  EXPECT_EQ(mesh.positions()[7], Vec3(0.5, 0, 0));
  EXPECT_NEAR(area(mesh, 5), 1, 1e-15) << "the walls follow after";
  EXPECT_TRUE(std::ranges::equal(before, whole)) << "who kept what was loaded still has it";
  EXPECT_EQ(mesh.triangleList->size(), 2u) << "attributes stay as the scene gave them";

  // a second change goes on from the first
  SurfaceEdit more;
  more.firstNewNode = 10;
  more.firstNewTriangle = 7;
  more.nodes = {{{0.75, 0, 0}, -1, {7, 1}, 0.5}};
  more.changed = {{2, {7, 10, 2}}};
  more.appended = {{{10, 1, 2}, 2, false}};
  cutSquare(*s.scene, more);
  EXPECT_EQ(mesh.positions().size(), 11u);
  EXPECT_EQ(mesh.triangles()[7], (Triangle{10, 1, 2}));

  s.scene->reset();
  EXPECT_TRUE(std::ranges::equal(mesh.triangles(), whole));
  EXPECT_EQ(mesh.positions().size(), 4u);
  cutSquare(*s.scene);
  EXPECT_TRUE(std::ranges::equal(mesh.triangles(), cutTriangles));
}

TEST(MeshTopology, hasNoOtherElementsOnceItIsCut) {
  const Loaded s = square();
  auto& mesh = s.find<MeshTopology>();
  mesh.edgeList.set({{0, 2}});
  EXPECT_EQ(mesh.edges().size(), 1u);
  cutSquare(*s.scene);
  EXPECT_TRUE(mesh.edges().empty()) << "the edge is split, and is in no list";
  s.scene->reset();
  EXPECT_EQ(mesh.edges().size(), 1u);
}

}  // namespace
}  // namespace stroma::test
