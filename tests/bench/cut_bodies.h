// SPDX-License-Identifier: Apache-2.0
// The same cut, relative to the particles' spacing, in bodies of different size.
#pragma once

#include "tests/bench/cut_timing.h"
#include "tests/components/mechanics/cut_scene.h"

namespace stroma::test {

// About 734, 12,000 and 100,000 particles.
inline constexpr std::array<std::array<Index, 3>, 3> cutBodies = {
    {{9, 9, 9}, {23, 23, 23}, {46, 47, 46}}};

// Means over the changes of the topology in one cut [s]: all of it, of that the division of the
// surface and the solid, and of the force field and the mapping.
struct CutCost {
  double change = 0, division = 0, mechanics = 0, longest = 0;
  Index changes = 0;
};

// Cut again and again from the same state, by one thread.
class CutBody {
 public:
  CutBody(const std::array<Index, 3>& n, const std::string& gradient) : n_(n) {
    setThreadCount(1);
    CutSceneOptions options;
    options.n = n;
    options.force = "gradient=\"" + gradient + "\"";
    options.more =
        "<Node name=\"clock\"><StartClock after=\"@../surface/mesh\"/><StopClock/></Node>";
    body_ = std::make_unique<CutScene>(options, addClocks);
  }

  // In the middle of the top face, four spacings long and three deep.
  CutCost cut() {
    if (cut_) {
      body_->scene.reset();
      body_->makeWhole(n_);
    }
    cut_ = true;
    StopClock::took.clear();
    body_->changes = 0;
    double follow = 0;
    body_->apply = [&](const TopologyChange& change) {
      const double start = threadSeconds();
      body_->scene.changeTopology(change);
      follow += threadSeconds() - start;
    };
    const double x = std::floor(0.5 * n_[0]) + 0.3, y = std::floor(0.5 * n_[1]) + 0.5;
    const auto poses = slit(n_, x, 0, y - 2, y + 2, 3);
    const double start = threadSeconds();
    body_->cut(poses);
    const double all = threadSeconds() - start;
    const double changes = body_->changes;
    return {all / changes, (all - follow) / changes, meanOf(StopClock::took),
            largestOf(StopClock::took), body_->changes};
  }

 private:
  std::array<Index, 3> n_;
  std::unique_ptr<CutScene> body_;
  bool cut_ = false;
};

}  // namespace stroma::test
