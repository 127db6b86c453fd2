// SPDX-License-Identifier: Apache-2.0
// What is recorded of a body that is cut while the scene runs.
#include <regex>

#include "core/interfaces/observer.h"
#include "tests/components/io/scratch_folder.h"
#include "tests/components/topology/hand_made_cut.h"

namespace stroma::test {
namespace {

class CutRecording : public ScratchFolder {
 protected:
  void load(const std::string& content, const std::string& meshAttributes = "") {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    options.outputFolder = folder_;
    scene_ = std::make_unique<Scene>(options);
    scene_->registry().add<Riding>("Riding");
    std::string text = squareScene(content);
    text.insert(text.find("triangles='"), meshAttributes + " ");
    const bool loaded = scene_->loadText(
        "<Node name='root' dt='0.5' gravity='0 0 1'>" + text + "</Node>", "test.xml");
    ASSERT_TRUE(loaded && scene_->initialise()) << log();
  }
  std::string log() { return scene_->diagnostics().text(); }
  void step() { ASSERT_TRUE(scene_->step()); }
  Observer& observer(const std::string& name) { return named<Observer>(*scene_, name); }
  double value(const std::string& monitor) { return observer(monitor).lastValues().at(0).second; }
  static int count(const std::string& text, const std::string& word) {
    int found = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
    return found;
  }
  std::unique_ptr<Scene> scene_;
};

TEST_F(CutRecording, exportersWriteTheTrianglesOfNow) {
  load(
      "<MeshExporter name='s' exportEveryNumberOfSteps='1'/>"
      "<VTKExporter name='v' exportEveryNumberOfSteps='1' "
      "pointsDataFields='given=mesh.position'/>");
  step();
  cutSquare(*scene_);
  step();
  step();
  scene_->reset();
  step();
  const std::string cut = read("s_000002.obj");
  EXPECT_EQ(count(cut, "v "), 10);
  std::string faces;
  for (const Triangle& t : cutTriangles) {
    faces += "f";
    for (const Index i : t) faces += " " + std::to_string(i + 1);
    faces += "\n";
  }
  EXPECT_TRUE(cut.ends_with(faces)) << cut;
  EXPECT_EQ(count(read("s_000001.obj"), "f "), 2) << "whole again";
  const std::string vtk = read("v_000002.vtp"), again = read("v_000001.vtp");
  EXPECT_NE(vtk.find("NumberOfPoints=\"10\""), vtk.npos) << vtk.substr(0, 300);
  EXPECT_NE(vtk.find("NumberOfPolys=\"7\""), vtk.npos) << vtk.substr(0, 300);
  EXPECT_EQ(vtk.find("\"given\""), vtk.npos) << "it has four values for ten points";
  EXPECT_NE(again.find("NumberOfPolys=\"2\""), vtk.npos);
  EXPECT_NE(again.find("\"given\""), vtk.npos);
  EXPECT_EQ(count(log(), "[field-size]"), 1) << log();
  EXPECT_EQ(observer("v").trouble() + observer("s").trouble(), "");
}

TEST_F(CutRecording, aSeriesKeepsItsKindOfFile) {
  load("<VTKExporter name='v' exportEveryNumberOfSteps='1'/>", "tetrahedra='0 1 2 3'");
  step();
  cutSquare(*scene_);
  step();
  // the tetrahedra are not divided, so that they are shown no more
  const std::string vtk = read("v_000002.vtu");
  EXPECT_NE(vtk.find("NumberOfCells=\"7\""), vtk.npos) << vtk.substr(0, 300);
  EXPECT_EQ(count(read("v.pvd"), ".vtu"), 2);
}

TEST_F(CutRecording, whatCannotFollowSaysSo) {
  load(
      "<VTKExporter name='uncut' topology='@old/mesh2' exportEveryNumberOfSteps='1'/>"
      "<Node name='old'><MeshTopology name='mesh2' position='" +
      squarePoints + "' triangles='" + squareTriangles +
      "'/></Node><Node name='copy'><MechanicalObject name='other' position='" + squarePoints +
      "'/><Riding input='@/particles'/><MeshExporter name='s' topology='@../mesh' "
      "exportEveryNumberOfSteps='1'/></Node>");
  step();
  for (int k = 0; k < 2; ++k) {
    cutSquare(*scene_);
    step();
    scene_->reset();
  }
  EXPECT_EQ(count(log(), "[export-uncut]"), 1) << log();
  EXPECT_NE(observer("s").trouble().find("have nodes that"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "s_000001.obj"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "s_000002.obj"));
}

TEST_F(CutRecording, monitorsFollowWhatTheyChose) {
  load(
      "<Monitor name='all' quantity='position' component='x' reduce='sum'/>"
      "<Monitor name='some' quantity='position' component='x' reduce='sum' indices='0 1 3'/>"
      "<Monitor name='each' quantity='position' component='x' reduce='each' indices='0 1 3'/>"
      "<Monitor name='way' component='z' reduce='max' since='0.5' indices='3'/>");
  step();
  EXPECT_NEAR(value("all"), 2, 1e-15);
  EXPECT_NEAR(value("some"), 1, 1e-15);
  const auto columns = observer("each").lastValues().size();
  step();
  const double way = value("way");
  cutSquare(*scene_);
  EXPECT_NEAR(value("all"), 2 + 1.0 / 3 + 0.5 + 1.0 / 3 + 0.5 + 0 + 0.3, 1e-15);
  EXPECT_NEAR(value("some"), 1 + 0.5 + 0.5 + 0, 1e-15) << "nodes 5, its copy 7, and 8";
  EXPECT_EQ(observer("each").lastValues().size(), columns);
  EXPECT_EQ(value("way"), way) << "the copy counts from where node 3 was";
  step();
  scene_->reset();
  EXPECT_NEAR(value("all"), 2, 1e-15);
  EXPECT_NEAR(value("some"), 1, 1e-15);
}

}  // namespace
}  // namespace stroma::test
