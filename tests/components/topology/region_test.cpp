// SPDX-License-Identifier: Apache-2.0
#include "components/topology/region.h"

#include <gtest/gtest.h>

#include "core/scene.h"

namespace stroma {
namespace {

SceneOptions options() {
  SceneOptions options;
  options.pluginFolders = {STROMA_TEST_MODULES};
  return options;
}

// The printed value of an attribute of a component of the root node.
std::string valueOf(Scene& scene, const std::string& component, const std::string& attribute) {
  for (const auto& c : scene.root().components()) {
    if (c->name() == component) return c->attribute(attribute)->print();
  }
  return "no such component";
}

// Diagnostics of a scene without solvers: what the components themselves had to say.
std::string load(Scene& scene, const std::string& components) {
  if (scene.loadText("<Node name=\"root\">" + components + "</Node>", "test.xml")) {
    (void)scene.initialise();
  }
  return scene.diagnostics().text();
}

TEST(Region, turnedBoxHoldsItsMiddleFace) {
  // middle face: the square (0,0,0) (1,1,0) (0,2,0), turned by 45 degrees about z
  const double numbers[10] = {0, 0, 0, 1, 1, 0, 0, 2, 0, 0.5};
  const OrientedBox box = orientedBox(numbers);
  EXPECT_TRUE(contains(box, Vec3(0, 1, 0.24)));
  EXPECT_TRUE(contains(box, Vec3(0, 1, -0.24)));
  EXPECT_FALSE(contains(box, Vec3(0, 1, 0.26)));
  EXPECT_FALSE(contains(box, Vec3(0.9, 0.2, 0)));
  EXPECT_TRUE(contains(box, Vec3(-0.9, 1, 0)));
}

TEST(BoxRoi, takesPointsOnItsBorder) {
  Scene scene(options());
  const std::string log = load(scene,
                               "<RegularGridTopology name='grid' n='3 3 3'/>"
                               "<BoxROI name='box' box='0 0 0 0.5 1 1  1 1 1 1 1 1' "
                               "position='@grid.position'/>");
  EXPECT_EQ(valueOf(scene, "box", "indices"), "0 1 3 4 6 7 9 10 12 13 15 16 18 19 21 22 24-26")
      << log;
}

TEST(BoxRoi, takesElementsOfTheTopology) {
  Scene scene(options());
  const std::string log = load(scene,
                               "<RegularGridTopology name='grid' n='2 2 2'/>"
                               "<BoxROI name='all' box='0 0 0 1 1 0' strict='true'/>"
                               "<BoxROI name='any' box='0 0 0 1 1 0' strict='false'/>");
  EXPECT_EQ(valueOf(scene, "all", "indices"), "0-3") << log;
  EXPECT_EQ(valueOf(scene, "all", "edgeIndices"), "0 1 4 5") << log;
  EXPECT_EQ(valueOf(scene, "all", "triangleIndices"), "8 9") << log;
  EXPECT_EQ(valueOf(scene, "any", "triangleIndices"), "0-9") << log;
}

TEST(BoxRoi, warnsWhenItSelectsNothing) {
  Scene scene(options());
  const std::string log =
      load(scene, "<RegularGridTopology name='grid'/><BoxROI name='box' box='5 5 5 6 6 6'/>");
  EXPECT_NE(log.find("[roi-empty]"), std::string::npos) << log;
}

TEST(SphereRoi, hasOneRadiusForAllOrOneEach) {
  Scene scene(options());
  const std::string log = load(scene,
                               "<RegularGridTopology name='grid' n='3 1 1' max='2 0 0'/>"
                               "<SphereROI name='one' centers='0 0 0 2 0 0' radii='0.5'/>"
                               "<SphereROI name='each' centers='0 0 0 2 0 0' radii='1 0.1'/>"
                               "<SphereROI name='bad' centers='0 0 0' radii='1 2'/>");
  EXPECT_EQ(valueOf(scene, "one", "indices"), "0 2") << log;
  EXPECT_EQ(valueOf(scene, "each", "indices"), "0-2") << log;
  EXPECT_NE(log.find("[roi-radii]"), std::string::npos) << log;
}

TEST(MeshTopology, answersToSofasNamesAndChecksIndices) {
  Scene scene(options());
  const std::string log = load(
      scene,
      "<TriangleSetTopologyContainer name='good' points='0 0 0 1 0 0 0 1 0' triangles='0 1 2'/>"
      "<MeshTopology name='bad' position='0 0 0 1 0 0' lines='0 2'/>"
      "<MeshTopology name='empty'/>");
  EXPECT_EQ(valueOf(scene, "good", "triangles"), "0 1 2") << log;
  EXPECT_NE(log.find("element 0 (0 2) uses point 2; there are 2 points"), std::string::npos) << log;
  EXPECT_NE(log.find("[topology-empty]"), std::string::npos) << log;
}

TEST(RegularGridTopology, takesCellWidthOrSeparateBounds) {
  Scene scene(options());
  const std::string log = load(scene,
                               "<RegularGridTopology name='cells' n='2 2 3' p0='1 0 0' "
                               "cellWidth='0.5'/>"
                               "<RegularGridTopology name='bounds' nx='2' ny='1' nz='1' xmin='-1' "
                               "xmax='3'/>"
                               "<RegularGridTopology name='bad' min='1 1 1' max='0 0 0'/>");
  EXPECT_EQ(valueOf(scene, "bounds", "position"), "-1 0 0 3 0 0") << log;
  EXPECT_TRUE(valueOf(scene, "cells", "position").ends_with("1.5 0.5 1")) << log;
  EXPECT_NE(log.find("[grid]"), std::string::npos) << log;
}

}  // namespace
}  // namespace stroma
