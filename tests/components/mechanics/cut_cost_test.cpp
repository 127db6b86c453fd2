// SPDX-License-Identifier: Apache-2.0
// What a cut costs must follow the cut, not the body.
#include <chrono>

#include "tests/components/mechanics/cut_scene.h"

namespace stroma::test {
namespace {

using Clock = std::chrono::steady_clock;

// Notes when the topologies have followed; force fields and mappings are next.
class StartClock final : public Topology {
 public:
  Link<Topology> after{this, "after", "The surface.", Lookup::explicitOnly};
  void topologyChanged(const TopologyChange&) override { at = Clock::now(); }
  [[nodiscard]] ConstVec3Span positions() const override { return {}; }
  static inline Clock::time_point at;
};

// Sums the time that they took.
class StopClock final : public Component {
 public:
  void topologyChanged(const TopologyChange&) override {
    const double took = std::chrono::duration<double>(Clock::now() - StartClock::at).count();
    sum += took;
    longest = std::max(longest, took);
  }
  static inline double sum = 0, longest = 0;
};

struct Cost {
  double mean, longest;
  Index changes;
};

// Of the quickest of several repetitions.
Cost costOf(const std::array<Index, 3>& n, const std::string& force) {
  CutSceneOptions options;
  options.n = n;
  options.force = force;
  options.more = "<Node name=\"clock\"><StartClock after=\"@../surface/mesh\"/><StopClock/></Node>";
  CutScene body(options, [](Registry& registry) {
    registry.add<StartClock>("StartClock");
    registry.add<StopClock>("StopClock");
  });
  Cost best{1e300, 1e300, 0};
  for (int repetition = 0; repetition < 5; ++repetition) {
    if (repetition > 0) {
      body.scene.reset();
      body.makeWhole(n);
    }
    StopClock::sum = StopClock::longest = 0;
    body.changes = 0;
    // in the middle of the top face, four spacings long and three deep
    const double x = std::floor(0.5 * n[0]) + 0.3, y = std::floor(0.5 * n[1]) + 0.5;
    body.cut(slit(n, x, 0, y - 2, y + 2, 3));
    best.mean = std::min(best.mean, StopClock::sum / body.changes);
    best.longest = std::min(best.longest, StopClock::longest);
    best.changes = body.changes;
  }
  return best;
}

TEST(CutCost, followsTheCutAndNotTheBody) {
  for (const char* force : {"gradient=\"plain\"", "gradient=\"consistent\""}) {
    std::vector<Cost> costs;
    for (const std::array<Index, 3>& n :
         {std::array<Index, 3>{9, 9, 9}, {23, 23, 23}, {46, 47, 46}}) {
      costs.push_back(costOf(n, force));
      std::printf("%s, %d particles: a change costs %.3f ms in the mean of %d, at most %.3f ms\n",
                  force, n[0] * n[1] * n[2], 1e3 * costs.back().mean, costs.back().changes,
                  1e3 * costs.back().longest);
    }
    EXPECT_LT(costs[2].mean, 1.5 * costs[0].mean);
    EXPECT_LT(costs[2].mean, 1.5 * costs[1].mean);
  }
}

}  // namespace
}  // namespace stroma::test
