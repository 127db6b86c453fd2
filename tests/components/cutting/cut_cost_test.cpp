// SPDX-License-Identifier: Apache-2.0
// The cost of a blade step follows the cut, not the body.
#include <algorithm>
#include <chrono>
#include <iostream>

#include "tests/components/cutting/cut_runner.h"
#include "tests/components/cutting/test_bodies.h"

namespace stroma::test {
namespace {

// Median time of a step in which the blade advances by half an edge, three edges deep.
double medianStep(int cells, Index& simplices) {
  using Clock = std::chrono::steady_clock;
  SimplicialComplex body =
      solid(block(Vec3::Constant(0.001 * cells), {cells, cells, cells}, 0.2, 7));
  simplices = body.simplexCount();
  Cutter cutter(body);
  const double h = cutter.spacing(), middle = 0.0005 * cells + 0.00013, top = 0.001 * cells;
  std::vector<double> times;
  for (int k = 0; k < 14; ++k) {
    const Vec3 x(-h + 0.5 * h * k, middle, 0);
    const auto pose = blade(x + Vec3(0, 0, top + h), x + Vec3(0, 0, top - 3 * h));
    const auto start = Clock::now();
    const SurfaceEdit edit = cutter.advance(pose);
    const std::chrono::duration<double> time = Clock::now() - start;
    if (k > 3 && !edit.empty()) times.push_back(time.count());
  }
  std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
  return times[times.size() / 2];
}

TEST(CutCost, aStepCostsTheSameInASmallAndALargeBody) {
  double small = 1e9;
  for (const int cells : {9, 22, 44}) {
    Index simplices = 0;
    double best = 1e9;
    for (int run = 0; run < 3; ++run) best = std::min(best, medianStep(cells, simplices));
    if (cells == 9) small = best;
    std::cout << simplices << " tetrahedra: " << 1e3 * best << " ms a step, " << best / small
              << " x\n";
    EXPECT_LT(best, 1.5 * small);
  }
  EXPECT_LT(small, 1e-3);
}

}  // namespace
}  // namespace stroma::test
