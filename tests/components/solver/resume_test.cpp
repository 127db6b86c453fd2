// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.h"
#include "tests/components/solver/test_scene.h"

namespace stroma::test {
namespace {

std::string chain(const std::string& solver, int count = 15) {
  return dtNode(0.005,
                solver + "<MechanicalObject position='" + line(count, 0.1) +
                    "'/><UniformMass vertexMass='0.02'/><Chain k='300'/><StiffeningSprings k='1' "
                    "c='50'/><FixedProjectiveConstraint indices='0'/>",
                "0 -9.81 0");
}

const std::vector<std::string> solvers = {
    "<EulerExplicitSolver estimateEvery='3'/>",
    "<EulerImplicitSolver/><CGLinearSolver warmStart='true'/>",
    "<EulerImplicitSolver/><CGLinearSolver preconditioner='jacobi'/>",
    "<EulerImplicitSolver/><SparseLDLSolver tolerance='1e-6'/>",
    "<EulerImplicitSolver/><SparseLDLSolver keepIterations='4'/>",
    "<EulerImplicitSolver newtonIterations='10' rayleighStiffness='0.001'/><SparseLDLSolver/>",
    "<StaticSolver/><SparseLDLSolver/>"};

TEST(Resume, continuesWithTheSameBits) {
  for (const std::string& solver : solvers) {
    Loaded whole = load(chain(solver));
    whole.run(37);
    const Snapshot half = whole.scene->save();
    whole.run(41);
    Loaded resumed = load(chain(solver));
    ASSERT_TRUE(resumed.scene->restore(half));
    resumed.run(41);
    EXPECT_EQ(whole.scene->stateHash(), resumed.scene->stateHash()) << solver;
    // a checkpoint right after a resume is as good as the first one
    Loaded again = load(chain(solver));
    ASSERT_TRUE(again.scene->restore(half));
    Loaded last = load(chain(solver));
    ASSERT_TRUE(last.scene->restore(again.scene->save()));
    last.run(41);
    EXPECT_EQ(whole.scene->stateHash(), last.scene->stateHash()) << solver;
  }
}

TEST(Resume, resetRepeatsTheRun) {
  for (const std::string& solver : solvers) {
    Loaded s = load(chain(solver));
    s.run(30);
    const std::uint64_t first = s.scene->stateHash();
    s.scene->reset();
    s.run(30);
    EXPECT_EQ(first, s.scene->stateHash()) << solver;
  }
}

TEST(Determinism, sameBitsAtAnyThreadCount) {
  for (const std::string& solver : solvers) {
    std::uint64_t hash[2];
    for (const int threads : {1, 2}) {
      setThreadCount(threads);
      Loaded s = load(chain(solver, 5000));
      s.run(3);
      hash[threads - 1] = s.scene->stateHash();
    }
    setThreadCount(1);
    EXPECT_EQ(hash[0], hash[1]) << solver;
  }
}

}  // namespace
}  // namespace stroma::test
