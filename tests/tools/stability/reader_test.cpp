// SPDX-License-Identifier: Apache-2.0
// Every suite of the folder `broken` is read and planned, and what it is answered is compared with
// the text beside it. STROMA_WRITE_EXPECTED=1 writes the texts anew: read them before you keep
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tools/stability/suite_plan.h"

namespace stroma::stability {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> suites() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(__FILE__).parent_path() / "broken")) {
    if (entry.path().extension() == ".xml") files.push_back("broken" / entry.path().filename());
  }
  std::ranges::sort(files);
  return files;
}

class BrokenSuite : public testing::TestWithParam<fs::path> {};

TEST_P(BrokenSuite, isAnsweredWithTheExpectedText) {
  Diagnostics diagnostics;
  const Suite suite = readSuite(GetParam(), diagnostics);
  if (diagnostics.errorCount() == 0) (void)makePlan(suite, {.out = "out"}, diagnostics);
  EXPECT_GE(diagnostics.errorCount(), 1);
  const std::string text = diagnostics.text();
  const fs::path expectedFile = fs::path(GetParam()).replace_extension(".txt");
  if (std::getenv("STROMA_WRITE_EXPECTED")) {
    std::ofstream(expectedFile, std::ios::binary) << text;
    return;
  }
  EXPECT_EQ(text, study::readFile(expectedFile).value_or("there is no such file"));
}

INSTANTIATE_TEST_SUITE_P(Folder, BrokenSuite, testing::ValuesIn(suites()),
                         [](const auto& instance) { return instance.param.stem().string(); });

std::vector<Cell> planned(const std::string& text, const PlanOptions& options = {.out = "out"}) {
  Diagnostics diagnostics;
  const Suite suite = readSuiteText(text, "broken/suite.xml", diagnostics);
  auto cells = makePlan(suite, options, diagnostics);
  EXPECT_EQ(diagnostics.errorCount(), 0) << diagnostics.text();
  return cells;
}

const std::string head = "<StabilitySuite title='T'><Method name='a' default='true' quick='true'/>";

TEST(SuitePlan, attributesOfWhatIsReplacedAreTakenOver) {
  const auto cells = planned(
      head +
      "<Method name='b'><Replace element='/ball/solver'><EulerImplicitSolver name='solver' "
      "rayleighMass='{rayleighMass}' tolerance='{tolerance}'/><CGLinearSolver/></Replace></Method>"
      "<Case name='fall' scene='fall.xml.in'/></StabilitySuite>");
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_NE(cells[1].sceneText.find("<EulerImplicitSolver name=\"solver\" rayleighMass=\"3\"/>"),
            std::string::npos)
      << cells[1].sceneText;
}

TEST(SuitePlan, editsOfACaseComeAfterThoseOfItsMethod) {
  const auto cells =
      planned(head +
              "<Method name='b'><Set attribute='/ball/solver.rayleighMass' value='4'/></Method>"
              "<Case name='fall' scene='fall.xml.in'><Set attribute='/ball/solver.rayleighMass' "
              "value='5' method='b'/></Case></StabilitySuite>");
  EXPECT_TRUE(cells[0].job.overrides.empty());
  EXPECT_EQ(cells[1].job.overrides.back(), "/ball/solver.rayleighMass=5");
}

TEST(SuitePlan, quickLeavesOutLongCasesAndOtherMethods) {
  const std::string suite = head +
                            "<Method name='b'/><Case name='fall' scene='fall.xml.in'/>"
                            "<Case name='far' scene='fall.xml.in' long='true'/></StabilitySuite>";
  const auto skipped = [](const std::vector<Cell>& cells) {
    std::string text;
    for (const Cell& cell : cells) text += cell.skipped ? '-' : 'x';
    return text;
  };
  EXPECT_EQ(skipped(planned(suite)), "xxxx");
  EXPECT_EQ(skipped(planned(suite, {.out = "out", .quick = true})), "x---");
  EXPECT_EQ(skipped(planned(suite, {.out = "out", .quick = true, .cases = {"fa*"}})), "x-x-");
  EXPECT_EQ(skipped(planned(suite, {.out = "out", .methods = {"b"}})), "-x-x");
}

TEST(SuitePlan, whatDoesNotApplyIsNotPlanned) {
  const auto cells =
      planned(head +
              "<Method name='b'/><Case name='fall' scene='fall.xml.in'>"
              "<NotApplicable method='b*' reason='why not'/></Case></StabilitySuite>");
  EXPECT_EQ(cells[1].notApplicable, "why not");
  EXPECT_TRUE(cells[1].sceneText.empty());
}

}  // namespace
}  // namespace stroma::stability
