// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>

#include "core/parallel.h"
#include "tests/components/boundary/boundary_scene.h"

namespace stroma::test {
namespace {

void shake(System& system) {
  for (std::size_t i = 0; i < system.x().size(); ++i) {
    const auto t = static_cast<double>(i);
    system.x()[i] += 0.1 * Vec3(std::sin(3 * t + 1), std::cos(5 * t), std::sin(7 * t + 2));
    system.v()[i] = Vec3(std::cos(2 * t), std::sin(4 * t), std::cos(6 * t + 1));
  }
  system.project(system.v());
}

// Matrix of the derivative: products with all unit vectors.
Eigen::MatrixXd productMatrix(const System& system, double stiffness, double damping) {
  const auto n = static_cast<std::size_t>(system.size());
  const auto rows = static_cast<Eigen::Index>(3 * n);
  Eigen::MatrixXd a(rows, rows);
  std::vector<Vec3> in(n), out(n);
  for (Eigen::Index c = 0; c < rows; ++c) {
    std::ranges::fill(in, Vec3::Zero());
    std::ranges::fill(out, Vec3::Zero());
    flat(Vec3Span(in))[c] = 1;
    system.addTangentProduct(in, stiffness, damping, out);
    a.col(c) = flat(Vec3Span(out));
  }
  return a;
}

struct Derivatives {
  Eigen::VectorXd force, fromEnergy;
  Eigen::MatrixXd byPosition, byVelocity;
};

// By central differences at time t.
Derivatives differences(System& system, double t) {
  const auto n = static_cast<std::size_t>(system.size());
  const auto rows = static_cast<Eigen::Index>(3 * n);
  Derivatives d{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::MatrixXd(rows, rows),
                Eigen::MatrixXd(rows, rows)};
  std::vector<Vec3> x(system.x().begin(), system.x().end());
  std::vector<Vec3> v(system.v().begin(), system.v().end());
  std::vector<Vec3> f(n), g(n);
  const StateView at{x, v, t};
  system.computeForce(at, f);
  d.force = flat(Vec3Span(f));
  const double h = 1e-5;
  const auto column = [&](std::vector<Vec3>& of, Eigen::Index c) {
    double& value = of[static_cast<std::size_t>(c / 3)][c % 3];
    const double middle = value;
    value = middle + h;
    system.computeForce(at, f);
    const double up = system.potentialEnergy(at);
    value = middle - h;
    system.computeForce(at, g);
    const double down = system.potentialEnergy(at);
    value = middle;
    if (&of == &x) d.fromEnergy[c] = -(up - down) / (2 * h);
    return Eigen::VectorXd((flat(Vec3Span(f)) - flat(Vec3Span(g))) / (2 * h));
  };
  for (Eigen::Index c = 0; c < rows; ++c) {
    d.byPosition.col(c) = column(x, c);
    d.byVelocity.col(c) = column(v, c);
  }
  return d;
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / std::max(1e-12, b.norm());
}

struct Law {
  const char* name;
  std::string content;
};

class ForceLaws : public testing::TestWithParam<Law> {};

TEST_P(ForceLaws, forceIsMinusEnergyGradientAndDerivativesMatch) {
  Loaded s = loadBoundary(onOctahedron(GetParam().content));
  System& system = s.system();
  shake(system);
  const double t = 0.3;
  const Derivatives d = differences(system, t);
  system.linearize({system.x(), system.v(), t});
  const Eigen::MatrixXd k = productMatrix(system, 1, 0), b = productMatrix(system, 0, 1);

  bool complete = false;
  BlockMatrix blocks(system.pattern(complete));
  system.addTangent(blocks, 0.7, 0.3);
  const Eigen::MatrixXd lower = blocks.lower();
  const Eigen::MatrixXd assembled = lower.selfadjointView<Eigen::Lower>();

  const bool dissipates = d.byVelocity.norm() > 0;
  const double force = dissipates ? 0 : relative(d.force, d.fromEnergy);
  std::printf("%-12s force %.1e, stiffness %.1e, damping %.1e, assembled %.1e, asymmetry %.1e\n",
              GetParam().name, force, relative(k, d.byPosition), relative(b, d.byVelocity),
              relative(assembled, 0.7 * k + 0.3 * b), relative(k, k.transpose()));
  EXPECT_LT(force, 1e-9);
  EXPECT_LT(relative(k, d.byPosition), 1e-8);
  EXPECT_LT(relative(b, d.byVelocity), 1e-8);
  EXPECT_TRUE(complete);
  EXPECT_LT(relative(assembled, 0.7 * k + 0.3 * b), 1e-14);
  EXPECT_LT(relative(k, k.transpose()), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(
    All, ForceLaws,
    testing::Values(Law{"springs", "<RestShapeSpringsForceField points='1 3' stiffness='5 7'/>"},
                    Law{"constant", "<ConstantForceField indices='0-2' forces='1 2 3 4 5 6'/>"},
                    Law{"pressure", "<SurfacePressureForceField pressure='3' rampTime='0.5'/>"},
                    Law{"traction", "<TractionForceField traction='1 2 3' triangleIndices='0 1'/>"},
                    Law{"grip",
                        "<GripForceField indices='0 4' stiffness='9' keyTimes='0 1' "
                        "displacements='0 0 0 1 2 3'/>"},
                    Law{"damping", "<UniformVelocityDampingForceField dampingCoefficient='0.4'/>"}),
    [](const auto& law) { return std::string(law.param.name); });

// On an open surface the energy and the derivative are exact for the nodes that are not on the rim.
TEST(SurfacePressure, openSurfaceIsExactWhereTheRimIsHeld) {
  Loaded s =
      loadBoundary(onOctahedron("<FixedProjectiveConstraint indices='0-3'/>"
                                "<SurfacePressureForceField pressure='3' "
                                "triangleIndices='0-3'/>"));
  System& system = s.system();
  shake(system);
  const Derivatives d = differences(system, 0);
  system.linearize({system.x(), system.v(), 0});
  const Eigen::MatrixXd k = productMatrix(system, 1, 0);
  EXPECT_LT(relative(d.force.segment<3>(12), d.fromEnergy.segment<3>(12)), 1e-9);
  EXPECT_LT((k.block<3, 3>(12, 12) - d.byPosition.block<3, 3>(12, 12)).norm(), 1e-8);
  EXPECT_LT(relative(k, k.transpose()), 1e-14);
}

TEST(SurfacePressure, positivePushesAlongNormalsAndSumsToNothingWhenClosed) {
  Loaded s = loadBoundary(onOctahedron("<SurfacePressureForceField pressure='6'/>"));
  System& system = s.system();
  system.computeForce({system.x(), system.v(), 0}, system.f());
  // each corner has four triangles with vector areas that add up to 2 along its axis; a third,
  // times p
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR((system.f()[i] - 4 * system.x()[i]).norm(), 0, 1e-14);
  }
  EXPECT_NEAR(s.find<SurfacePressureForceField>().volume(system.x()), 4.0 / 3, 1e-15);
  shake(system);
  system.computeForce({system.x(), system.v(), 0}, system.f());
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < 6; ++i) {
    sum += system.f()[i];
    moment += system.x()[i].cross(system.f()[i]);
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
}

TEST(SurfacePressure, rampIsSmooth) {
  Loaded s =
      loadBoundary(onOctahedron("<SurfacePressureForceField pressure='2 kPa' rampTime='1'/>"));
  const auto& load = s.find<SurfacePressureForceField>();
  EXPECT_EQ(load.pressureAt(0), 0);
  EXPECT_DOUBLE_EQ(load.pressureAt(0.5), 1000);
  EXPECT_EQ(load.pressureAt(1), 2000);
  EXPECT_EQ(load.pressureAt(7), 2000);
  EXPECT_LT(load.pressureAt(1e-3), 0.01);
}

TEST(Traction, uniformStressHasNoResultantOnAClosedSurface) {
  Loaded s = loadBoundary(onOctahedron("<TractionForceField stress='5 3 -2 1 4 2'/>"));
  System& system = s.system();
  system.computeForce({system.x(), system.v(), 0}, system.f());
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 virial = Mat3::Zero();
  for (std::size_t i = 0; i < 6; ++i) {
    sum += system.f()[i];
    moment += system.rest()[i].cross(system.f()[i]);
    virial += system.f()[i] * system.rest()[i].transpose();
  }
  Mat3 stress;
  stress << 5, 1, 2, 1, 3, 4, 2, 4, -2;
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
  EXPECT_LT((virial - stress * 4.0 / 3).norm(), 1e-14) << "sum f X^T = stress x volume";
}

// The divergence theorem: sum f = div stress x volume, sum f X^T = integral of the stress + f X^T.
TEST(Traction, linearStressIsIntegratedExactly) {
  Loaded s = loadBoundary(
      onOctahedron("<TractionForceField stress='5 3 -2 1 4 2' stressOrigin='0.1 0.2 -0.3' "
                   "stressGradient='1 2 3 4 5 6  -2 0 1 3 1 2  4 1 -1 0 2 5'/>"));
  System& system = s.system();
  system.computeForce({system.x(), system.v(), 0}, system.f());
  Vec3 sum = Vec3::Zero();
  Mat3 virial = Mat3::Zero();
  for (std::size_t i = 0; i < 6; ++i) {
    sum += system.f()[i];
    virial += system.f()[i] * system.rest()[i].transpose();
  }
  const double volume = 4.0 / 3;
  Mat3 middle, x, y, z;  // stress at the centre, derivatives
  x << 1, 4, 6, 4, 2, 5, 6, 5, 3;
  y << -2, 3, 2, 3, 0, 1, 2, 1, 1;
  z << 4, 0, 5, 0, 1, 2, 5, 2, -1;
  middle << 5, 1, 2, 1, 3, 4, 2, 4, -2;
  middle -= 0.1 * x + 0.2 * y - 0.3 * z;
  EXPECT_LT((sum - volume * (x.col(0) + y.col(1) + z.col(2))).norm(), 1e-13);
  EXPECT_LT((virial - volume * middle).norm(), 1e-13);
}

TEST(Traction, forceIsTractionTimesArea) {
  Loaded s =
      loadBoundary(onOctahedron("<TractionForceField traction='0 0 3' triangleIndices='0 2'/>"));
  System& system = s.system();
  system.computeForce({system.x(), system.v(), 0}, system.f());
  double z = 0;
  for (const Vec3& f : system.f()) z += f.z();
  EXPECT_NEAR(z, 3 * 2 * std::sqrt(3) / 2, 1e-14);
}

TEST(Loads, actOnMappedStates) {
  Loaded s = loadBoundary(dtNode(
      0.01,
      "<EulerImplicitSolver/><SparseLDLSolver tolerance='1e-13'/><MechanicalObject position='" +
          line(5, 1) +
          "'/><UniformMass vertexMass='1'/><StiffeningSprings k='100'/><Node name='surface'>"
          "<MechanicalObject position='0 0 0 2 0 0 4 0 0'/><EveryOther/>"
          "<RestShapeSpringsForceField points='1' stiffness='50'/>"
          "<ConstantForceField indices='1' totalForce='0 15 0'/></Node>"));
  s.run(2000);
  // 150 N/m against 15 N on particle 2
  EXPECT_NEAR(s.system().x()[2].y(), 0.1, 1e-6);
  EXPECT_NEAR(s.system().x()[1].y(), 0, 1e-12);
}

TEST(Pressure, sameBitsAtAnyThreadCount) {
  std::string points, triangles;
  const int n = 60;
  for (int i = 0; i < n * n; ++i) {
    points += std::to_string(i % n) + " " + std::to_string(i / n) + " " +
              std::to_string(0.01 * (i % 7)) + " ";
  }
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      for (const int corner : {a, a + 1, a + n, a + 1, a + n + 1, a + n}) {
        triangles += std::to_string(corner) + " ";
      }
    }
  }
  std::uint64_t hash[2];
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    Loaded s = loadBoundary(
        dtNode(0.01, "<EulerImplicitSolver/><CGLinearSolver/><WrittenMesh position='" + points +
                         "' triangles='" + triangles +
                         "'/><MechanicalObject/><UniformMass vertexMass='1'/>"
                         "<SurfacePressureForceField pressure='3'/><StiffeningSprings k='9'/>"));
    s.run(5);
    hash[threads - 1] = s.scene->stateHash();
  }
  setThreadCount(1);
  EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
}  // namespace stroma::test
