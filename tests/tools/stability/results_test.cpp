// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tools/stability/suite_results.h"

namespace stroma::stability {
namespace {

struct Example {
  Suite suite;
  std::vector<Cell> cells;
  Results results;
  Example() {
    suite.title = "Hard <cases>";
    suite.methods = {{"own", "", {}, true, true, {}}, {"other", "", {}, false, false, {}}};
    suite.cases.resize(2);
    suite.cases[0].name = "one";
    suite.cases[1].name = "two";
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t m = 0; m < 2; ++m) {
        Cell cell{.caseNumber = c, .method = m};
        cell.job.id = std::to_string(c) + std::to_string(m);
        cells.push_back(cell);
      }
    }
    for (const Cell& cell : cells) {
      results[cell.job.id] = {{"id", cell.job.id}, {"status", "passed"}, {"message", ""}};
    }
  }
  [[nodiscard]] std::string lastLine() const {
    const std::string text = textOf(summarise(suite, cells, results, {}));
    const auto end = text.rfind('\n', text.size() - 2);
    return text.substr(end + 1);
  }
};

TEST(SuiteResults, theLastLineCountsCases) {
  EXPECT_EQ(Example().lastLine(), "2 cases: 2 passed, 0 failed\n");
}

TEST(SuiteResults, aCaseFailsWithADefaultMethodOnly) {
  Example e;
  e.results["01"]["status"] = "failed";
  e.results["01"]["message"] = "maxSpeed 3";
  EXPECT_EQ(e.lastLine(), "2 cases: 2 passed, 0 failed\n");
  const std::string text = textOf(summarise(e.suite, e.cells, e.results, {}));
  EXPECT_NE(text.find("FAIL  one, other: maxSpeed 3\n"), std::string::npos);
  EXPECT_NE(text.find("methods compared: 1 of 2 runs passed"), std::string::npos);
  e.results["10"]["status"] = "diverged";
  EXPECT_EQ(e.lastLine(), "2 cases: 1 passed, 1 failed\n");
}

TEST(SuiteResults, crashesTimeOutsAndInvalidScenesFail) {
  for (const char* status : {"crashed", "timed out", "invalid", "diverged", "failed"}) {
    Example e;
    e.results["00"]["status"] = status;
    EXPECT_EQ(e.lastLine(), "2 cases: 1 passed, 1 failed\n") << status;
  }
}

TEST(SuiteResults, whatDidNotRunIsNotCounted) {
  Example e;
  e.results.erase("00");
  e.cells[0].skipped = true;
  EXPECT_EQ(e.lastLine(), "1 cases: 1 passed, 0 failed\n");
}

TEST(SuiteResults, limitersThatActedAreNamed) {
  Example e;
  e.results["00"]["limiters"] = {{"/body/solver.shortened", 7}};
  const std::string text = textOf(summarise(e.suite, e.cells, e.results, {}));
  EXPECT_NE(text.find("one, own: /body/solver.shortened 7\n"), std::string::npos);
}

TEST(SuiteResults, thePageNeedsItsParts) {
  const Example e;
  std::string problem;
  const auto summary = summarise(e.suite, e.cells, e.results, {{"processor", "p"}});
  EXPECT_FALSE(pageOf(summary, e.results, "/nowhere", problem));
  EXPECT_NE(problem.find("/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace stroma::stability
