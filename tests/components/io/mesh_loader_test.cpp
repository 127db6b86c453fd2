// SPDX-License-Identifier: Apache-2.0
#include "core/interfaces/mesh.h"
#include "core/scene.h"
#include "tests/components/io/scratch_folder.h"

namespace stroma {
namespace {

class Loader : public ScratchFolder {
 protected:
  // Diagnostics of a scene beside the scratch files.
  std::string load(Scene& scene, const std::string& components) {
    if (scene.loadText("<Node name=\"root\">" + components + "</Node>", folder_ / "test.xml")) {
      (void)scene.initialise();
    }
    return scene.diagnostics().text();
  }
  static SceneOptions options() {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    return options;
  }
  static std::string valueOf(Scene& scene, const std::string& component,
                             const std::string& attribute) {
    for (const auto& c : scene.root().components()) {
      if (c->name() == component) return c->attribute(attribute)->print();
    }
    return "no such component";
  }
};

TEST_F(Loader, scalesThenRotatesThenShifts) {
  write("a.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  Scene scene(options());
  const std::string log = load(scene,
                               "<MeshOBJLoader name='mesh' filename='a.obj' scale='2' "
                               "rotation='90 0 90' translation='0 0 5'/>"
                               "<MeshTopology name='topology' src='@mesh'/>");
  // x first: ex -> ex, ey -> ez, ez -> -ey; then z: ex -> ey, ez -> ez, -ey -> ex
  const auto* mesh = dynamic_cast<const Mesh*>(scene.root().components().front().get());
  ASSERT_EQ(mesh->positions().size(), 3u) << log;
  EXPECT_LT((mesh->positions()[0] - Vec3(0, 2, 5)).norm(), 1e-14);
  EXPECT_LT((mesh->positions()[1] - Vec3(0, 0, 7)).norm(), 1e-14);
  EXPECT_LT((mesh->positions()[2] - Vec3(2, 0, 5)).norm(), 1e-14);
  EXPECT_EQ(valueOf(scene, "topology", "position"), valueOf(scene, "mesh", "position"));
  EXPECT_EQ(valueOf(scene, "topology", "triangles"), "0 1 2");
}

TEST_F(Loader, reflectionKeepsFacesOutwards) {
  write("a.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  Scene scene(options());
  const std::string log = load(scene,
                               "<MeshOBJLoader name='mirror' filename='a.obj' scale3d='-1 1 1'/>"
                               "<MeshOBJLoader name='flip' filename='a.obj' flipNormals='1'/>");
  EXPECT_EQ(valueOf(scene, "mirror", "triangles"), "0 2 1") << log;
  EXPECT_EQ(valueOf(scene, "flip", "triangles"), "0 2 1") << log;
}

TEST_F(Loader, groupsSelectPointsAndTriangles) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng left\nf 1 2 3\ng right\nf 2 4 3\n");
  Scene scene(options());
  const std::string log = load(scene,
                               "<MeshOBJLoader name='mesh' filename='a.obj'/>"
                               "<MeshGroupROI name='right' group='right'/>"
                               "<MeshGroupROI name='only' group='right' strict='true'/>"
                               "<MeshGroupROI name='bad' group='middle'/>");
  EXPECT_EQ(valueOf(scene, "right", "indices"), "1-3") << log;
  EXPECT_EQ(valueOf(scene, "right", "triangleIndices"), "1") << log;
  EXPECT_EQ(valueOf(scene, "only", "indices"), "3") << log;
  EXPECT_NE(log.find("its groups: left, right"), std::string::npos) << log;
}

TEST_F(Loader, pointsAtTheSceneAndAtTheMeshFile) {
  write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 9\n");
  Scene scene(options());
  const std::string log = load(scene, "<MeshOBJLoader filename='bad.obj'/>");
  EXPECT_NE(log.find("test.xml:1:"), std::string::npos) << log;
  EXPECT_NE(log.find("bad.obj:4: index 4 names no point"), std::string::npos) << log;
  EXPECT_NE(log.find("bad.obj:5: index 9 names no point"), std::string::npos) << log;
}

TEST_F(Loader, doubtsUnlikelySizes) {
  write("mm.obj", "v 0 0 0\nv 12 0 0\nv 0 11 0\nf 1 2 3\n");
  Scene scene(options()), scaled(options());
  EXPECT_NE(load(scene, "<MeshOBJLoader filename='mm.obj'/>").find("[mesh-size]"),
            std::string::npos);
  EXPECT_EQ(load(scaled, "<MeshOBJLoader filename='mm.obj' scale='0.001'/>").find("[mesh-size]"),
            std::string::npos);
}

}  // namespace
}  // namespace stroma
