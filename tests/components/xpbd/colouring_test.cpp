// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/colouring.h"

#include <set>

#include "tests/components/xpbd/pair_body.h"

namespace stroma::test {
namespace {

TEST(Colouring, elementsOfOneColourShareNoNodeAndAllAreThere) {
  const PairBody body(6);
  const Colouring c = colourElements({body.elements.front().data(), 4 * body.elements.size()}, 4,
                                     static_cast<Index>(body.rest.size()));
  for (Index k = 0; k < c.colours(); ++k) {
    std::set<Index> nodes;
    for (Index place = c.begin[k]; place < c.begin[k + 1]; ++place) {
      for (const Index i : body.elements[c.order[place]])
        EXPECT_TRUE(nodes.insert(i).second) << "colour " << k << ", node " << i;
    }
  }
  const std::set<Index> all(c.order.begin(), c.order.end());
  EXPECT_EQ(all.size(), body.elements.size());
  EXPECT_EQ(c.begin.back(), static_cast<Index>(body.elements.size()));
  std::printf("%zu tetrahedra, 24 at a node: %d colours\n", body.elements.size(), c.colours());
  EXPECT_LT(c.colours(), 48);
}

TEST(Colouring, oneSweepHasTheSameBitsAtAnyNumberOfThreads) {
  std::vector<Vec3> moved[2];
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    PairBody body(10);
    body.pairs.setModuli({3, 8});
    body.x = randomField(body.rest.size(), 0.3, 5);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += body.rest[i];
    for (int k = 0; k < 3; ++k) EXPECT_EQ(body.project(0.5), 0u);
    moved[threads - 1] = body.x;
  }
  setThreadCount(1);
  EXPECT_TRUE(moved[0] == moved[1]);
}

}  // namespace
}  // namespace stroma::test
