// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "tests/components/cutting/random_cuts.h"

namespace stroma::test {
namespace {

TEST(RandomCuts, keepEveryInvariant) { checkRandomCuts(1, 120); }

TEST(RandomCuts, giveTheSameBitsTwice) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::array<std::uint64_t, 2> hash;
    for (std::uint64_t& h : hash) {
      SimplicialComplex body = randomBody(seed);
      Cutter cutter(body);
      const RandomCut cut = RandomCuts(seed, body, cutter.spacing()).next();
      for (const Sweep& sweep : cut.sweeps) (void)runCut(body, cutter, sweep, cut.steps, 0);
      h = topologyHash(body);
    }
    EXPECT_EQ(hash[0], hash[1]) << "seed " << seed;
  }
}

// Short segments across the swept surface, away from its borders, must meet a separated facet.
TEST(RandomCuts, leaveNoHoles) {
  constexpr double side = 0.01, border = 0.8, reach = 0.45;
  constexpr unsigned seeds = 20, samples = 2000;
  Index tested = 0, open = 0, twice = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SimplicialComplex complex = solid(block(Vec3::Constant(side), {8, 8, 8}, 0.2, seed));
    Cutter cutter(complex);
    const double h = cutter.spacing();
    RandomCuts cuts(seed, complex, h);
    const Sweep sweep = cuts.once();
    CutFacets facets(h);
    CutSheet sheet(h / 4);
    constexpr int steps = 40;
    for (int k = 0; k <= steps; ++k) {
      const auto pose = sweep(double(k) / steps);
      facets.add(cutter.advance(pose).cutFacets);
      sheet.addPose(pose);
    }
    facets.add(cutter.finish().cutFacets);
    sheet.finish();
    std::vector<Vec3> rim;
    CutFacets swept(h);
    const auto columns = static_cast<std::size_t>(sheet.columnCount());
    for (Index r = 0; r < sheet.rowCount(); ++r) {
      if (r + 1 < sheet.rowCount()) swept.add(sheet.strip(r));
      for (std::size_t c = 0; c < columns; ++c)
        if (r == 0 || r + 1 == sheet.rowCount() || c == 0 || c + 1 == columns)
          rim.push_back(sheet.row(r)[c]);
    }
    for (unsigned k = 0; k < samples; ++k) {
      const auto r = static_cast<Index>(cuts.uniform(0, sheet.rowCount() - 1.001));
      const auto c = static_cast<std::size_t>(cuts.uniform(0, sheet.columnCount() - 1.001));
      const Vec3 x = (sheet.row(r)[c] + sheet.row(r + 1)[c + 1]) / 2;
      const Vec3 n = (sheet.row(r)[c + 1] - sheet.row(r)[c])
                         .cross(sheet.row(r + 1)[c] - sheet.row(r)[c])
                         .normalized();
      const Vec3 p = x + reach * h * n, q = x - reach * h * n;
      const auto outside = [&](const Vec3& y) {
        return (y.array() < 0).any() || (y.array() > side).any();
      };
      if (outside(p) || outside(q)) continue;
      if (std::any_of(rim.begin(), rim.end(),
                      [&](const Vec3& y) { return (y - x).norm() < border * h; }))
        continue;
      const auto count = [&](const CutFacets& set) {
        return std::count_if(set.facets().begin(), set.facets().end(), [&](const auto& t) {
          return segmentCrossesTriangle(p, q, t[0], t[1], t[2]);
        });
      };
      if (count(swept) != 1) continue;
      ++tested;
      const auto blocked = count(facets);
      open += blocked == 0 ? 1 : 0;
      twice += blocked > 1 ? 1 : 0;
    }
  }
  std::cout << tested << " segments across the sheet: " << open << " not blocked, " << twice
            << " blocked more than once\n";
  EXPECT_GT(tested, 1000);
  EXPECT_EQ(open, 0);
}

}  // namespace
}  // namespace stroma::test
