// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tests/components/cutting/random_cuts.h"

namespace stroma::test {
namespace {

TEST(ManyCuts, aThousandKeepEveryInvariant) { checkRandomCuts(1001, 1000); }

// The shipped solids, one random cut each time.
TEST(ManyCuts, ofWholeOrgansLeaveFewSlivers) {
  for (const auto& [name, first, count] :
       {std::tuple("cornea_shell", 1U, 500U), std::tuple("liver", 501U, 500U)}) {
    const SimplicialComplex whole = sceneSolid(name);
    std::vector<double> slivers;
    double angle = 180;
    for (unsigned seed = first; seed < first + count; ++seed) {
      SimplicialComplex body = whole;
      Cutter cutter(body);
      const RandomCut cut = RandomCuts(seed, body, cutter.spacing()).next();
      for (const Sweep& sweep : cut.sweeps) {
        for (int k = 0; k <= cut.steps; ++k)
          static_cast<void>(cutter.advance(sweep(static_cast<double>(k) / cut.steps)));
        static_cast<void>(cutter.finish());
      }
      const SurfaceNumbers numbers = checkInvariants(body);
      EXPECT_TRUE(numbers.failures.empty()) << "seed " << seed;
      slivers.push_back(numbers.sliverFraction);
      angle = std::min(angle, numbers.smallestAngle);
    }
    std::ranges::sort(slivers);
    std::printf(
        "%s: %u cuts, slivers %.2f %% in the median, 99 of 100 below %.2f %%, worst %.2f %%; "
        "smallest angle %.3f deg\n",
        name, count, 100 * slivers[slivers.size() / 2], 100 * slivers[slivers.size() * 99 / 100],
        100 * slivers.back(), angle);
    EXPECT_LT(slivers[slivers.size() / 2], 0.005);
    EXPECT_LT(slivers[slivers.size() * 95 / 100], 0.01);
    EXPECT_LT(slivers.back(), 0.02);
  }
}

}  // namespace
}  // namespace stroma::test
