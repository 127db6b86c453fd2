// SPDX-License-Identifier: Apache-2.0
// What a step costs, with 3,200 nodes: 15,066 tetrahedra, 2,511 hexahedra, or springs along all of
// their edges and diagonals. One thread.
#include <chrono>

#include "core/parallel.h"
#include "tests/components/fem/beam_scene.h"

namespace stroma::test {
namespace {

double bestStep(const Beam& beam, int steps) {
  setThreadCount(1);
  const auto scene = load(beam);
  double best = 1e9;
  for (int k = 0; k < steps; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(scene->step());
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (k > 2) best = std::min(best, took.count());
  }
  return best;
}

std::string conjugateGradients(int iterations) {
  return "<EulerImplicitSolver name=\"solver\"/><CGLinearSolver name=\"linear\" iterations=\"" +
         std::to_string(iterations) + "\" tolerance=\"1e-30\"/>";
}

TEST(Speed, ofExplicitAndImplicitSteps) {
  struct Case {
    const char* name;
    std::string forceField;
    double explicitStep, implicitStep;  // allowed, ms
  };
  const Case cases[] = {{"tetrahedra", tetrahedra, 3.1, 25.8},
                        {"hexahedra", hexahedra, 1.5, 27.2},
                        {"springs", springs, 2.0, 9.9}};
  for (const Case& c : cases) {
    const std::string split = c.forceField == springs ? "none" : "six";
    const double explicitly = bestStep({"<EulerExplicitSolver name=\"solver\" substeps=\"1\"/>",
                                        c.forceField, "32 10 10", split, "0 0 -0.1", "5e-4"},
                                       200);
    const double few =
        bestStep({conjugateGradients(5), c.forceField, "32 10 10", split, "0 0 -0.1", "0.01"}, 20);
    const double many =
        bestStep({conjugateGradients(25), c.forceField, "32 10 10", split, "0 0 -0.1", "0.01"}, 20);
    std::printf("%s: explicit %.2f ms, implicit with 25 iterations %.1f ms, an iteration %.3f ms\n",
                c.name, explicitly, many, (many - few) / 20);
    EXPECT_LT(explicitly, c.explicitStep) << c.name;
    EXPECT_LT(many, c.implicitStep) << c.name;
  }
}

}  // namespace
}  // namespace stroma::test
