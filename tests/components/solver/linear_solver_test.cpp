// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>

#include "components/solver/packed_factor.h"
#include "core/parallel.h"
#include "tests/components/solver/test_scene.h"

namespace stroma::test {
namespace {

// A stretched chain, held at one end, with a partly loaded state.
Loaded stretched(const std::string& linearSolver, const std::string& chain = "") {
  Loaded s = load(dtNode(0.01, "<EulerImplicitSolver/>" + linearSolver +
                                   "<MechanicalObject position='" + line(20, 0.1) +
                                   "'/><UniformMass vertexMass='0.02'/><Chain k='300' " + chain +
                                   "/><StiffeningSprings k='3' c='100'/>"
                                   "<FixedProjectiveConstraint indices='0'/>"));
  for (std::size_t i = 1; i < 20; ++i) {
    const auto t = static_cast<double>(i);
    s.system().x()[i] += Vec3(0.01 * t, 0.02 * std::sin(t), 0.02 * std::cos(t));
  }
  return s;
}

std::vector<Vec3> rightSide(const System& system) {
  std::vector<Vec3> b(static_cast<std::size_t>(system.size()));
  for (std::size_t i = 0; i < b.size(); ++i) {
    const auto t = static_cast<double>(i);
    b[i] = Vec3(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t + 1));
  }
  system.project(b);
  return b;
}

Eigen::MatrixXd dense(const SystemMatrix& matrix) {
  const auto n = static_cast<std::size_t>(matrix.system.size());
  const auto rows = static_cast<Eigen::Index>(3 * n);
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(rows, rows);
  std::vector<Vec3> in(n), out(n);
  for (Eigen::Index c = 0; c < rows; ++c) {
    std::ranges::fill(in, Vec3::Zero());
    flat(Vec3Span(in))[c] = 1;
    matrix.system.project(in);
    if (flat(Vec3Span(in)).isZero()) continue;
    matrix.multiply(in, out);
    a.col(c) = flat(Vec3Span(out));
  }
  return a;
}

double errorAgainstDense(Loaded& s, double massFactor = 1) {
  System& system = s.system();
  system.linearize({system.x(), system.v(), 0});
  const SystemMatrix matrix{system, massFactor, 0.01, 1e-2};
  const std::vector<Vec3> b = rightSide(system);
  std::vector<Vec3> x(b.size(), Vec3::Zero());
  const LinearSolution solution = s.find<LinearSolver>().solve(matrix, b, x);
  const Eigen::VectorXd exact = dense(matrix).fullPivLu().solve(flat(ConstVec3Span(b)));
  const double error = (flat(ConstVec3Span(x)) - exact).norm() / exact.norm();
  std::printf("%-16s %3d iterations, residual %.1e, error %.1e\n",
              s.find<LinearSolver>().type().c_str(), solution.iterations, solution.residual, error);
  EXPECT_TRUE(solution.converged);
  return error;
}

TEST(LinearSolvers, solveAsADenseMatrixDoes) {
  for (const std::string solver :
       {"<CGLinearSolver tolerance='1e-13' iterations='200'/>",
        "<CGLinearSolver tolerance='1e-13' iterations='200' preconditioner='jacobi'/>",
        "<SparseLDLSolver/>"}) {
    Loaded s = stretched(solver);
    EXPECT_LT(errorAgainstDense(s), 1e-10);
  }
}

TEST(LinearSolvers, assembledMatrixIsTheProducts) {
  Loaded s = stretched("<SparseLDLSolver/>");
  System& system = s.system();
  system.linearize({system.x(), system.v(), 0});
  const SystemMatrix matrix{system, 1, 0.01, 1e-2};
  bool complete = false;
  BlockMatrix blocks(system.pattern(complete));
  matrix.assemble(blocks);
  EXPECT_TRUE(complete);
  const Eigen::MatrixXd lower = blocks.lower();
  const Eigen::MatrixXd full = lower.selfadjointView<Eigen::Lower>();
  EXPECT_LT((full - dense(matrix)).norm(), 1e-13 * full.norm());
}

TEST(PackedFactor, solvesToSinglePrecision) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    Loaded s = stretched("<SparseLDLSolver/>");
    System& system = s.system();
    system.linearize({system.x(), system.v(), 0});
    const SystemMatrix matrix{system, 1, 0.01, 1e-2};
    bool complete = false;
    BlockMatrix blocks(system.pattern(complete));
    matrix.assemble(blocks);
    const BlockFactor factor(blocks.lower());
    std::vector<Vec3> b = rightSide(system), x(b.size());
    for (Vec3& value : b) value *= scale;
    PackedFactor(factor).solve(b, x);
    const Eigen::VectorXd exact = factor.solve(flat(ConstVec3Span(b)));
    const double error = (flat(ConstVec3Span(x)) - exact).norm() / exact.norm();
    std::printf("right side of %.0e: error %.1e\n", scale, error);
    EXPECT_LT(error, 1e-5);
  }
}

TEST(PackedFactor, anySizeOfMatrixIsSolvedAndNaNIsSeen) {
  for (const double size : {1e-60, 1e60}) {
    Eigen::SparseMatrix<double> matrix(3, 3);
    for (int i = 0; i < 3; ++i) matrix.insert(i, i) = (1 + i) * size;
    matrix.insert(1, 0) = matrix.insert(2, 0) = matrix.insert(2, 1) = 0.5 * size;
    const BlockFactor factor(matrix);
    PackedFactor packed(factor);
    std::vector<Vec3> b{{1, 2, 3}}, x(1);
    packed.solve(b, x);
    const Vec3 exact = factor.solve(b[0]);
    EXPECT_LT((x[0] - exact).norm(), 1e-5 * exact.norm());
    b[0].y() = std::nan("");
    packed.solve(b, x);
    EXPECT_FALSE(x[0].allFinite());
  }
}

TEST(PackedFactor, aMatrixWithoutWholeBlocksIsRefused) {
  Eigen::SparseMatrix<double> matrix(6, 6);
  for (int i = 0; i < 6; ++i) matrix.insert(i, i) = 2;
  matrix.insert(4, 0) = 1;
  const BlockFactor factor(matrix);
  EXPECT_THROW(PackedFactor{factor}, std::invalid_argument);
}

TEST(SparseLDL, iteratesOverWhatCannotBeAssembled) {
  Loaded s = stretched("<SparseLDLSolver tolerance='1e-12'/>", "assembles='false'");
  EXPECT_LT(errorAgainstDense(s), 1e-9);
  EXPECT_GT(s.find<SparseLDLSolver>().lastIterations, 1);
}

TEST(SparseLDL, keptFactorGivesTheSameResult) {
  Loaded s = stretched("<SparseLDLSolver tolerance='1e-10'/>");
  EXPECT_LT(errorAgainstDense(s), 1e-8);
  for (std::size_t i = 1; i < 20; ++i) s.system().x()[i] *= 1.01;
  EXPECT_LT(errorAgainstDense(s), 1e-8);
  EXPECT_EQ(s.find<SparseLDLSolver>().factorizations, 1);
  EXPECT_GT(s.find<SparseLDLSolver>().lastIterations, 1);
}

TEST(SparseLDL, factorIsRenewedWhenItNoLongerConverges) {
  Loaded s = stretched("<SparseLDLSolver keepIterations='3' tolerance='1e-12'/>");
  EXPECT_LT(errorAgainstDense(s), 1e-9);
  EXPECT_LT(errorAgainstDense(s, 50), 1e-9);
  EXPECT_EQ(s.find<SparseLDLSolver>().factorizations, 2);
  EXPECT_EQ(limiter(s.find<SparseLDLSolver>(), "notConverged"), 0u);
}

TEST(SparseLDL, indefiniteMatrixIsShiftedAndCounted) {
  Loaded s = stretched("<SparseLDLSolver/>");
  System& system = s.system();
  // a squeezed chain wants to buckle
  for (std::size_t i = 0; i < 20; ++i) system.x()[i] = 0.3 * system.rest()[i];
  system.linearize({system.x(), system.v(), 0});
  const std::vector<Vec3> b = rightSide(system);
  std::vector<Vec3> x(b.size(), Vec3::Zero());
  (void)s.find<LinearSolver>().solve({system, 0, 0, 1}, b, x);
  EXPECT_EQ(limiter(s.find<SparseLDLSolver>(), "shifted"), 1u);
  EXPECT_GT(dot(b, x), 0) << "the result must point downhill";
}

TEST(CG, tooFewIterationsAreCounted) {
  Loaded s = stretched("<CGLinearSolver iterations='3' tolerance='1e-10'/>");
  s.run(2);
  EXPECT_EQ(limiter(s.find<CGLinearSolver>(), "notConverged"), 2u);
  EXPECT_GT(s.find<CGLinearSolver>().lastResidual, 1e-10);
}

TEST(CG, warmStartTakesFewerIterations) {
  const auto iterations = [](const std::string& attributes) {
    Loaded s = stretched("<CGLinearSolver iterations='200' tolerance='1e-8' " + attributes + "/>");
    int sum = 0;
    for (int i = 0; i < 50; ++i) {
      EXPECT_TRUE(s.scene->step());
      sum += s.find<CGLinearSolver>().lastIterations;
    }
    return sum;
  };
  const int cold = iterations(""), warm = iterations("warmStart='true'");
  std::printf("iterations in 50 steps: %d cold, %d warm\n", cold, warm);
  EXPECT_LE(warm, cold);
}

TEST(CG, thresholdIsNotedToHaveNoEffect) {
  Loaded s = stretched("<CGLinearSolver threshold='1e-9' iterations='200'/>");
  EXPECT_NE(s.text().find("'threshold' has no effect"), std::string::npos) << s.text();
}

TEST(SparseLDL, oneSolverForTwoSystemsIsAnError) {
  const std::string body =
      "<EulerImplicitSolver/><MechanicalObject position='0 0 0'/><UniformMass totalMass='1'/>";
  const Loaded s = tryLoad(dtNode(0.1, "<SparseLDLSolver/><Node name='a'>" + body +
                                           "</Node><Node name='b'>" + body + "</Node>"));
  EXPECT_FALSE(s.ready);
  EXPECT_NE(s.text().find("used by 2 solvers"), std::string::npos) << s.text();
}

}  // namespace
}  // namespace stroma::test
