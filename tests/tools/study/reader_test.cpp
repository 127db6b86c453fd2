// SPDX-License-Identifier: Apache-2.0
// Every study of the folder `broken` is read and planned, and what it is answered is compared with
// the text beside it. STROMA_WRITE_EXPECTED=1 writes the texts anew: read them before you keep
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tools/study/plan.h"

namespace stroma::study {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> studies() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(__FILE__).parent_path() / "broken")) {
    if (entry.path().extension() == ".xml") files.push_back("broken" / entry.path().filename());
  }
  std::ranges::sort(files);
  return files;
}

std::string answerTo(const fs::path& file) {
  Diagnostics diagnostics;
  const Study study = readStudy(file, diagnostics);
  if (diagnostics.errorCount() == 0) {
    (void)makePlan(study, {"out", "cache", {}, {}}, diagnostics);
  }
  return diagnostics.text();
}

class BrokenStudy : public testing::TestWithParam<fs::path> {};

TEST_P(BrokenStudy, isAnsweredWithTheExpectedText) {
  const std::string text = answerTo(GetParam());
  const fs::path expectedFile = fs::path(GetParam()).replace_extension(".txt");
  if (std::getenv("STROMA_WRITE_EXPECTED")) {
    std::ofstream(expectedFile, std::ios::binary) << text;
    return;
  }
  EXPECT_EQ(text, readFile(expectedFile).value_or("there is no such file"));
}

INSTANTIATE_TEST_SUITE_P(Folder, BrokenStudy, testing::ValuesIn(studies()),
                         [](const auto& instance) { return instance.param.stem().string(); });

Study readText(const std::string& text) {
  Diagnostics diagnostics;
  Study study = readStudyText(text, "study.xml", diagnostics);
  EXPECT_EQ(diagnostics.errorCount(), 0) << diagnostics.text();
  return study;
}

TEST(StudyReader, aStudyMayBeItsOneQuestion) {
  const Study study = readText(
      "<Study title='T' scene='a.xml' repeats='7'><Measure name='m' monitor='/m' reference='-2 "
      "mm'/>"
      "<Budget error='5 %' ms='2'/><Published name='p' ms='18' error='10 %'/></Study>");
  ASSERT_EQ(study.questions.size(), 1u);
  EXPECT_EQ(study.repeats, 7);
  const Question& question = study.questions.front();
  EXPECT_EQ(question.measures.front().reference->value, -0.002);
  EXPECT_EQ(question.errorBudgets, std::vector<double>{0.05});
  EXPECT_EQ(question.msBudgets, std::vector<double>{2});
  EXPECT_EQ(question.published.front().ms, 18);
  EXPECT_EQ(question.methods.size(), 1u);
}

TEST(StudyReader, timesMayHaveAnyUnitOfTime) {
  const Study study = readText(
      "<Study title='T' scene='a.xml' time='20 ms'><Measure name='m' of='energy'/>"
      "<Budget ms='5 us'/></Study>");
  EXPECT_EQ(study.questions.front().time, 0.02);
  EXPECT_NEAR(study.questions.front().msBudgets.front(), 0.005, 1e-15);
}

TEST(StudyReader, aGridHasItsPointsInTheBox) {
  const Study study = readText(
      "<Study title='T' scene='a.xml'><Measure name='m' state='/s' grid='3 1 2' box='0 0 0 2 2 4'/>"
      "</Study>");
  const auto& points = study.questions.front().measures.front().points;
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points.front(), Vec3(0, 1, 0));
  EXPECT_EQ(points.back(), Vec3(2, 1, 4));
}

TEST(StudyReader, aFieldMayBeComparedWithDisplacements) {
  const Study study = readText(
      "<Study title='T' scene='a.xml'><Measure name='m' state='/s' points='0 0 0  1 0 0' "
      "reference='0 0 1  0 0 2 mm'/></Study>");
  const Measure& measure = study.questions.front().measures.front();
  ASSERT_EQ(measure.referenceField.size(), 2u);
  EXPECT_EQ(measure.referenceField.back(), Vec3(0, 0, 0.002));
  EXPECT_FALSE(measure.reference);
}

TEST(StudyReader, aReactionNamesItsConstraintAndPart) {
  const Study study = readText(
      "<Study title='T' scene='a.xml'><Measure name='m' of='reaction' constraint='/c' "
      "component='z' reference='3 mN'/></Study>");
  const Measure& measure = study.questions.front().measures.front();
  EXPECT_EQ(measure.kind, Measure::Kind::reaction);
  EXPECT_EQ(measure.path, "/c");
  EXPECT_EQ(measure.axis, 3u);
  EXPECT_EQ(measure.reference->value, 0.003);
}

}  // namespace
}  // namespace stroma::study
