// SPDX-License-Identifier: Apache-2.0
#include "tests/components/cutting/random_cuts.h"

#include <algorithm>
#include <iostream>
#include <map>

namespace stroma::test {

SimplicialComplex randomBody(unsigned seed) {
  constexpr double side = 0.01;
  switch (seed % 7) {
    case 0:
      return solid(block(Vec3::Constant(side), {6, 6, 6}, 0.2, seed));
    case 1:
      return solid(block(Vec3::Constant(side), {6, 6, 6}, 0, seed));
    case 2:
      return solid(shell(14, 2));
    case 3:
      return solid(ball(side / 2, 6));
    default:
      return disk(0.006, 10, seed % 2 ? 0.0078 : 0);
  }
}

void checkRandomCuts(unsigned first, unsigned count) {
  std::map<std::string, int> kinds;
  Worst all;
  double slivers = 0, triangles = 0, worstSlivers = 0;
  Index smallest = std::numeric_limits<Index>::max();
  for (unsigned seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SimplicialComplex body = randomBody(seed);
    const double volume = checkInvariants(body).volume;
    Cutter cutter(body);
    const RandomCut cut = RandomCuts(seed, body, cutter.spacing()).next();
    SCOPED_TRACE(cut.kind);
    ++kinds[cut.kind];
    Index pieces = 1;
    for (std::size_t k = 0; k < cut.sweeps.size(); ++k) {
      const std::uint64_t hash = topologyHash(body);
      all.merge(runCut(body, cutter, cut.sweeps[k], cut.steps, volume));
      if (cut.kind == "again" && k == 1) {
        EXPECT_EQ(topologyHash(body), hash);
      }
      const Index now = pieceCount(body);
      EXPECT_GE(now, pieces);
      pieces = now;
    }
    const SurfaceNumbers n = checkInvariants(body, volume);
    std::vector<Index> sizes(n.pieces.size(), 0);
    for (const Index p : body.pieces(pieces)) ++sizes[static_cast<std::size_t>(p)];
    smallest = std::min(smallest, *std::min_element(sizes.begin(), sizes.end()));
    worstSlivers = std::max(worstSlivers, n.sliverFraction);
    slivers += n.sliverFraction * static_cast<double>(body.surface().size());
    triangles += static_cast<double>(body.surface().size());
    if (::testing::Test::HasFailure()) return;
  }
  std::cout << "seeds " << first << " to " << first + count - 1 << ", " << all.steps
            << " changes checked: openness " << all.openness << ", volume mismatch " << all.volume
            << ", smallest angle " << all.angle << " deg, least height " << all.height
            << " edges, slivers " << 100 * slivers / triangles << " % (worst body "
            << 100 * worstSlivers << " %), smallest piece " << smallest << " simplices, "
            << all.retired << " nodes retired;";
  for (const auto& [kind, number] : kinds) std::cout << ' ' << kind << ' ' << number;
  std::cout << '\n';
  EXPECT_LT(slivers, 0.02 * triangles);
}

}  // namespace stroma::test
