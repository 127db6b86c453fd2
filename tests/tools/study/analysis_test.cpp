// SPDX-License-Identifier: Apache-2.0
#include "tools/study/analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/study/plan.h"
#include "tools/study/slurm.h"

namespace stroma::study {
namespace {

std::vector<Point> points(const std::vector<std::pair<double, double>>& costsAndErrors) {
  std::vector<Point> list;
  for (const auto& [cost, error] : costsAndErrors) {
    list.push_back({"m", "p" + std::to_string(list.size()), cost, error, cost, cost});
  }
  return list;
}

TEST(ParetoFront, holdsWhatNobodyBeatsInBoth) {
  const auto all = points({{3, 0.1}, {1, 0.5}, {2, 0.6}, {2, 0.2}, {9, 0.1}, {10, 0.01}});
  EXPECT_EQ(paretoFront(all), (std::vector<std::size_t>{1, 3, 0, 5}));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(FitOrder, findsTheExponentOfAPowerLaw) {
  for (const double order : {0.5, 1.0, 2.0, 3.7}) {
    std::vector<std::pair<double, double>> pairs;
    for (const double h : {0.1, 0.07, 0.03, 0.01}) pairs.emplace_back(h, 4.2 * std::pow(h, order));
    const auto fit = fitOrder(pairs);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, order, 1e-12);
    EXPECT_EQ(fit->points, 3);
  }
}

TEST(FitOrder, looksAtTheThreeFinestOnly) {
  const auto fit = fitOrder({{0.4, 77}, {0.2, 0.04}, {0.1, 0.01}, {0.05, 0.0025}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->order, 2, 1e-12);
}

TEST(FitOrder, needsThreeSizesAndErrorsThatAreNotZero) {
  EXPECT_FALSE(fitOrder({{0.2, 0.04}, {0.1, 0.01}}));
  EXPECT_FALSE(fitOrder({{0.2, 0.04}, {0.1, 0.01}, {0.1, 0.02}}));
  EXPECT_FALSE(fitOrder({{0.2, 0.04}, {0.1, 0.01}, {0.05, 0}}));
}

TEST(Sentences, nameTheFastestAndTheMostAccurate) {
  const std::vector<Point> all{{"a", "a, 4", 0.5, 0.04, 0.4, 0.6},
                               {"a", "a, 8", 3, 0.01, 2, 4},
                               {"b", "b, 4", 0.1, 0.2, 0.1, 0.1}};
  const auto said = sentences(all, {{0.05}, {1}});
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0], "At 5 % error the fastest is a, 4 (0.5 ms a step, 4 % error).");
  EXPECT_EQ(
      said[1],
      "What each method needs for 5 % error: a 0.5 ms a step; b does not get there (best 20 %).");
  EXPECT_EQ(said[2], "Within 1 ms a step the most accurate is a, 4 (0.5 ms a step, 4 % error).");
}

TEST(Sentences, nameARivalWhoseTimesOverlap) {
  const std::vector<Point> all{{"a", "a, 4", 0.5, 0.04, 0.4, 0.6},
                               {"b", "b, 4", 0.7, 0.03, 0.55, 0.8},
                               {"c", "c, 4", 0.9, 0.03, 0.7, 1}};
  EXPECT_EQ(sentences(all, {{0.05}, {}})[0],
            "At 5 % error the fastest is a, 4 (0.5 ms a step, 4 % error); within the spread of the "
            "times so is b, 4 (0.7 ms a step, 3 % error).");
}

TEST(Sentences, sayThatABudgetIsOutOfReach) {
  const auto said = sentences(points({{10, 0.3}, {20, 0.2}}), {{0.05}, {1}});
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0], "None reaches 5 % error: the best is p1 (20 ms a step, 20 % error).");
  EXPECT_EQ(said[1],
            "None stays within 1 ms a step: the fastest is p0 (10 ms a step, 30 % error).");
  EXPECT_EQ(sentences({}, {{0.05}, {1}}).size(), 1u);
}

TEST(Sentences, orderWhatHasNoErrorByItsCost) {
  EXPECT_EQ(orderOfCosts({{"a", "a", 0.5, 0, 0.4, 0.6},
                          {"b", "b", 0.25, 0, 0.2, 0.45},
                          {"c", "c", 1, 0, 0.9, 1.1}},
                         "ms a step"),
            "The fastest is b (0.25 ms a step); then a (0.5, 2 times, within the spread), c (1, 4 "
            "times).");
  EXPECT_EQ(beside("paper", 18, {"a", "a, 4", 0.125, 0, 0.1, 0.2}),
            "paper: 18 ms, 144 times a, 4 (0.125 ms), on another machine.");
}

Axis axis(const std::string& name, const std::vector<std::string>& points) {
  Axis made;
  made.name = name;
  for (const std::string& point : points) made.points.push_back({.name = point});
  return made;
}

TEST(Combinations, areTheProductOfMethodsAndAxesWithoutWhatIsSkipped) {
  Question question;
  question.methods = {{.name = "MLS, plain"}, {.name = "MLS, consistent"}, {.name = "hexahedra"}};
  question.axes = {axis("layers", {"4", "8"}), axis("step", {"1", "2", "5"})};
  EXPECT_EQ(combinations(question, 0).size(), 18u);
  question.skips.push_back({{{"method", {"MLS*"}}, {"step", {"5"}}}});
  question.skips.push_back({{{"layers", {"8"}}, {"step", {"1", "2"}}}});
  const auto all = combinations(question, 7);
  EXPECT_EQ(all.size(), 18u - 4u - 6u);
  EXPECT_EQ(labelOf(all.front()), "MLS, plain, layers 4, step 1");
  EXPECT_EQ(all.front().question, 7u);
  for (const Variation& v : all) EXPECT_NE(labelOf(v), "MLS, plain, layers 4, step 5");
}

TEST(ShellWord, keepsQuotesAndDollars) {
  EXPECT_EQ(shellWord("a b"), "'a b'");
  EXPECT_EQ(shellWord("it's $5"), "'it'\\''s $5'");
}

}  // namespace
}  // namespace stroma::study
