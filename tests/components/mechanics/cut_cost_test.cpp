// SPDX-License-Identifier: Apache-2.0
// What a cut costs must follow the cut, not the body.
#include "tests/bench/cut_bodies.h"

namespace stroma::test {
namespace {

// Of the quickest of several repetitions.
CutCost costOf(const std::array<Index, 3>& n, const char* gradient) {
  CutBody body(n, gradient);
  CutCost best = body.cut();
  constexpr int repetitions = 5;
  for (int k = 1; k < repetitions; ++k) {
    const CutCost cost = body.cut();
    if (cost.change < best.change) best = cost;
  }
  return best;
}

TEST(CutCost, followsTheCutAndNotTheBody) {
  for (const char* gradient : {"plain", "consistent"}) {
    std::vector<CutCost> costs;
    for (const std::array<Index, 3>& n : cutBodies) {
      costs.push_back(costOf(n, gradient));
      const CutCost& c = costs.back();
      std::printf(
          "%s, %d particles: a change costs %.3f ms in the mean of %d (division %.3f, mechanics "
          "%.3f, at most %.3f)\n",
          gradient, n[0] * n[1] * n[2], 1e3 * c.change, c.changes, 1e3 * c.division,
          1e3 * c.mechanics, 1e3 * c.longest);
    }
    EXPECT_LT(costs[2].change, 1.5 * costs[0].change);
    EXPECT_LT(costs[2].change, 1.5 * costs[1].change);
  }
}

}  // namespace
}  // namespace stroma::test
