// SPDX-License-Identifier: Apache-2.0
#include <tinyxml2.h>

#include "core/interfaces/integrator.h"
#include "core/interfaces/observer.h"
#include "core/scene.h"
#include "tests/components/io/scratch_folder.h"

namespace stroma {
namespace {

// Moves particle i by (i + 1) mm along x a second, and leaves the force (0, 0, 2) N on all.
class Drift final : public Integrator {
 public:
  Attribute<double> strain{
      this, "strain", 0.0, "A number that follows the time.", {.output = true}};
  Attribute<std::vector<double>> heat{this, "heat", {}, "One number a particle.", {.output = true}};
  void bind() override { heat.set({1, 2, 3, 4, 5, 6, 7, 8}); }
  void integrate(const StepContext& step) override {
    for (std::size_t i = 0; i < system().x().size(); ++i) {
      const Vec3 speed(1e-3 * static_cast<double>(i + 1), 0, 0);
      system().v()[i] = speed;
      system().x()[i] += step.dt * speed;
      system().f()[i] = Vec3(0, 0, 2);
    }
    strain.set(step.time + step.dt);
  }
};

class Recording : public ScratchFolder {
 protected:
  std::unique_ptr<Scene> scene(const std::string& components, bool writes = true) {
    SceneOptions options;
    options.pluginFolders = {STROMA_TEST_MODULES};
    options.outputFolder = folder_;
    options.writesOutput = writes;
    auto made = std::make_unique<Scene>(options);
    made->registry().add<Drift>("Drift");
    const bool loaded = made->loadText(
        "<Node name='root' dt='0.5' gravity='0 0 0'><Drift name='drift'/>"
        "<RegularGridTopology name='grid'/><MechanicalObject name='state'/>"
        "<UniformMass totalMass='1'/>" +
            components + "</Node>",
        "test.xml");
    EXPECT_TRUE(loaded && made->initialise()) << made->diagnostics().text();
    return made;
  }
  static Observer& observer(Scene& scene) {
    for (const auto& c : scene.root().components()) {
      if (auto* found = dynamic_cast<Observer*>(c.get())) return *found;
    }
    throw std::logic_error("the scene has no observer");
  }
  // Files listed by a series; every one must exist and none be partly written.
  std::vector<std::string> listed(const std::string& pvd) const {
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.LoadFile((folder_ / pvd).c_str()), tinyxml2::XML_SUCCESS) << pvd;
    std::vector<std::string> files;
    const auto* root = document.FirstChildElement("VTKFile");
    if (!root) return files;
    for (const auto* e = root->FirstChildElement("Collection")->FirstChildElement("DataSet"); e;
         e = e->NextSiblingElement("DataSet")) {
      files.emplace_back(e->Attribute("file"));
      const std::string text = read(files.back());
      EXPECT_TRUE(text.ends_with("</VTKFile>\n")) << files.back();
    }
    return files;
  }
};

TEST_F(Recording, seriesIsValidAfterEveryStep) {
  auto run = scene(
      "<VTKExporter filename='sub/box' exportEveryNumberOfSteps='2' exportAtBegin='1' "
      "exportAtEnd='1' pointsDataFields='temperature=@drift.heat'/>");
  std::filesystem::path sub = folder_ / "sub";
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(run->step());
    folder_ = sub;
    EXPECT_EQ(listed("box.pvd").size(), static_cast<std::size_t>(1 + (i + 1) / 2));
    folder_ = sub.parent_path();
  }
  run->stop();
  folder_ = sub;
  const auto files = listed("box.pvd");
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0], "box_000000.vtu");
  EXPECT_EQ(files[3], "box_000005.vtu");
  EXPECT_NE(read(files[3]).find("Name=\"temperature\""), std::string::npos);
  folder_ = sub.parent_path();
  EXPECT_EQ(observer(*run).trouble(), "");
}

TEST_F(Recording, seriesGoesOnAfterResumption) {
  const char* exporter = "<VTKExporter filename='box' exportEveryNumberOfSteps='1'/>";
  Snapshot snapshot;
  {
    auto run = scene(exporter);
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
    snapshot = run->save();
    ASSERT_TRUE(run->step());  // lost
  }
  auto run = scene(exporter);
  ASSERT_TRUE(run->restore(snapshot));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
  EXPECT_EQ(listed("box.pvd"), (std::vector<std::string>{"box_000001.vtu", "box_000002.vtu",
                                                         "box_000003.vtu", "box_000004.vtu"}));
}

TEST_F(Recording, nothingIsWrittenWithoutOutput) {
  auto run = scene("<VTKExporter filename='box' exportEveryNumberOfSteps='1'/><Monitor/>", false);
  ASSERT_TRUE(run->step());
  run->stop();
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Recording, troubleIsToldOnceAndTheRunGoesOn) {
  write("wall", "a file where a folder should be");
  auto run = scene("<VTKExporter filename='wall/box' exportEveryNumberOfSteps='1'/>");
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(run->step());
  EXPECT_NE(observer(*run).trouble().find("cannot write"), std::string::npos);
  EXPECT_EQ(run->diagnostics().errorCount(), 1);
}

TEST_F(Recording, monitorMeasuresBeforeOrAfterReducing) {
  const auto last = [&](const std::string& attributes) {
    auto run = scene("<Monitor name='m' " + attributes + "/>", false);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(run->step());  // 2 s
    return observer(*run).lastValues();
  };
  using Values = std::vector<std::pair<std::string, double>>;
  const auto near = [](const Values& values, const Values& expected) {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(values[i].first, expected[i].first);
      EXPECT_NEAR(values[i].second, expected[i].second, 1e-12) << values[i].first;
    }
  };
  near(last("indices='0 2'"), {{"m", 4e-3}});
  near(last("indices='0-2' reduce='max'"), {{"m", 6e-3}});
  near(last("indices='0-2' reduce='sum' component='x'"), {{"m", 12e-3}});
  near(last("indices='1 2' reduce='each' component='x'"), {{"m[1]", 4e-3}, {"m[2]", 6e-3}});
  near(last("quantity='reaction' reduce='sum' component='vector'"),
       {{"m_x", 0}, {"m_y", 0}, {"m_z", -16}});
  near(last("quantity='kineticEnergy'"), {{"m", 0.5 * 204e-6 / 8}});
  near(last("attribute='@drift.strain'"), {{"m", 2}});
  near(last("attribute='@drift.heat' reduce='max'"), {{"m", 8}});
}

TEST_F(Recording, monitorWritesEveryRowAtOnceAndWithUnits) {
  auto run = scene("<Monitor name='apex' indices='0' component='x'/>");
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
  EXPECT_EQ(read("apex.csv"), "step,time (s),apex (m)\n0,0,0\n1,0.5,5e-04\n2,1,0.001\n");
}

TEST_F(Recording, monitorDropsRowsThatAResumptionRepeats) {
  Snapshot snapshot;
  std::string whole;
  {
    auto run = scene("<Monitor name='apex' quantity='velocity'/>");
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
    snapshot = run->save();
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
    whole = read("apex.csv");
  }
  auto run = scene("<Monitor name='apex' quantity='velocity'/>");
  ASSERT_TRUE(run->restore(snapshot));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
  EXPECT_EQ(read("apex.csv"), whole);
}

TEST_F(Recording, deformedSurfaceIsWrittenAtTheEnd) {
  auto run = scene(
      "<MeshExporter filename='end' format='ply' exportAtEnd='1' "
      "exportEveryNumberOfSteps='2'/>");
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(run->step());
  run->stop();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "end_000002.ply"));
  EXPECT_EQ(read("end.ply"), read("end_000002.ply"));
}

}  // namespace
}  // namespace stroma
