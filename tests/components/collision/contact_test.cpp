// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "core/parallel.h"
#include "tests/components/collision/collision_scene.h"

namespace stroma::test {
namespace {

const std::string probe = "<ProbeTool name='probe' device='@hand' radius='0.5'/>";
// one point
const std::string needle = "<ScalpelTool name='probe' device='@hand' length='1' sampleCount='1'/>";

std::string contact(const std::string& attributes) {
  return "<PenaltyContactForceField name='contact' tools='@probe' " + attributes + "/>";
}

RigidTool& toolOf(const Loaded& s) { return s.find<RigidTool>(); }

TEST(Contact, sphereOnAPlaneIsPushedByStiffnessTimesDepth) {
  const Loaded s = loadCollision(hand("0 10", "0.4 -0.2 0.7  0.4 -0.2 0.4") + probe +
                                 heldSurface(grid(1, 4)) + contact("stiffness='70'"));
  for (int k = 1; k <= 12; ++k) {
    s.run(1);
    const double depth = std::max(0.0, 0.5 - toolOf(s).pose().position.z());
    EXPECT_NEAR((toolOf(s).totalForce() - Vec3(0, 0, 70 * depth)).norm(), 0, 1e-12);
    EXPECT_NEAR(s.find<PenaltyContactForceField>().depth, depth, 1e-15);
    EXPECT_EQ(toolOf(s).contactCount, depth > 0 ? 1 : 0);
  }
  EXPECT_NEAR(toolOf(s).totalForce().z(), 7, 1e-12);
  EXPECT_NEAR(toolOf(s).totalTorque().norm(), 0, 1e-12);
}

TEST(Contact, needleBelowThePlaneIsPushedBackUp) {
  const Loaded s = loadCollision(hand("0 10", "0.4 -0.2 0.1  0.4 -0.2 -0.3") + needle +
                                 heldSurface(grid(1, 4)) + contact("stiffness='70'"));
  s.run(12);
  EXPECT_NEAR((toolOf(s).totalForce() - Vec3(0, 0, 21)).norm(), 0, 1e-12);
  EXPECT_NEAR((toolOf(s).contacts().front().normal - Vec3(0, 0, 1)).norm(), 0, 1e-12);
}

TEST(Contact, toolAndMappedSurfaceFeelOppositeForces) {
  std::mt19937 random(1);
  Surface sheet = grid(6, 0.15);
  shake(sheet.x, random, 0.01);
  const Loaded s = loadCollision(
      hand("0 20 40", "0 0 0.55  0 0 0.35  0.05 0.02 0.35") + probe +
      "<EulerImplicitSolver rayleighMass='50'/><CGLinearSolver tolerance='1e-12' "
      "iterations='500'/><MechanicalObject position='" +
      text(sheet.x, 2) +
      "'/><UniformMass vertexMass='1e-4'/><StiffeningSprings k='20'/>"
      "<Node name='surface'>" +
      meshOf(sheet) +
      "<MechanicalObject name='nodes'/><Between/><BVHCollisionModel name='collision'/>"
      "<PenaltyContactForceField tools='@/probe' stiffness='200' friction='0.3'/></Node>");
  auto& field = s.find<PenaltyContactForceField>();
  auto& mapping = s.find<Between>();
  double worst = 0;
  int touched = 0;
  for (int k = 0; k < 40; ++k) {
    s.run(1);
    const Vec3 onTool = toolOf(s).totalForce();
    if (onTool.isZero()) continue;
    ++touched;
    const Vec3 onSurface = totalOn(field, s.scene->time());
    // the particles get the same through the transpose
    std::vector<Vec3> f(field.state().x().size(), Vec3::Zero());
    field.addForce(field.state().view(s.scene->time()), f);
    std::vector<Vec3> onParticles(mapping.input().x().size(), Vec3::Zero());
    mapping.addTransposed(f, onParticles);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& one : onParticles) sum += one;
    worst = std::max({worst, (onTool + onSurface).norm() / onTool.norm(),
                      (onTool + sum).norm() / onTool.norm()});
  }
  EXPECT_GT(touched, 30);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(toolOf(s).contactCount, 3);
  EXPECT_LT(toolOf(s).totalForce().x(), -0.01) << "friction holds against the motion";
  std::printf("third law: largest relative sum of the forces %.1e, %d points touch\n", worst,
              *toolOf(s).contactCount);
}

class Response : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::string law() const { return " response='" + GetParam() + "'"; }
};
INSTANTIATE_TEST_SUITE_P(Contact, Response, testing::Values("penalty", "constraint"));

TEST_P(Response, forceIsMinusEnergyGradientAndTangentItsDerivative) {
  std::mt19937 random(2);
  Surface sheet = grid(6, 0.15);
  shake(sheet.x, random, 0.01);
  const Loaded s =
      loadCollision(hand("0 20 40", "0 0 0.55  0 0 0.4  0.05 0.02 0.4") + probe +
                    softSurface(sheet, 20) + contact("stiffness='200' friction='0.3'" + law()));
  s.run(30);
  auto& field = s.find<PenaltyContactForceField>();
  std::vector<Vec3> x(field.state().x().begin(), field.state().x().end());
  const std::vector<Vec3> v(x.size(), Vec3::Zero());
  const StateView at{x, v, 0};
  const auto force = [&] {
    std::vector<Vec3> f(x.size(), Vec3::Zero());
    field.addForce(at, f);
    return f;
  };
  field.linearize(at);
  const std::vector<Vec3> f0 = force();
  constexpr double h = 1e-7;
  double worstForce = 0, worstTangent = 0, size = 0, tangentSize = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      std::vector<Vec3> dx(x.size(), Vec3::Zero()), df(x.size(), Vec3::Zero());
      dx[i][c] = 1;
      field.addTangentProduct(dx, 1, 0, df);
      const double from = x[i][c];
      x[i][c] = from + h;
      const double up = field.potentialEnergy(at);
      const std::vector<Vec3> fUp = force();
      x[i][c] = from - h;
      const double down = field.potentialEnergy(at);
      const std::vector<Vec3> fDown = force();
      x[i][c] = from;
      size = std::max(size, std::abs(f0[i][c]));
      worstForce = std::max(worstForce, std::abs(f0[i][c] + (up - down) / (2 * h)));
      for (std::size_t j = 0; j < x.size(); ++j) {
        tangentSize = std::max(tangentSize, df[j].norm());
        worstTangent = std::max(worstTangent, (df[j] - (fUp[j] - fDown[j]) / (2 * h)).norm());
      }
    }
  }
  EXPECT_GT(size, 0.1);
  EXPECT_LT(worstForce / size, 1e-7);
  EXPECT_LT(worstTangent / tangentSize, 1e-7);
  std::printf("force against energy %.1e, tangent against force %.1e (relative)\n",
              worstForce / size, worstTangent / tangentSize);
}

TEST(Friction, slidingStaysOnTheCone) {
  const Loaded s =
      loadCollision(hand("0 10 60", "0 0 0.6  0 0 0.4  0.8 0.3 0.4") + probe +
                    heldSurface(grid(1, 8)) + contact("stiffness='100' friction='0.25'"));
  s.run(58);
  const Vec3 f = toolOf(s).totalForce();
  const Vec3 along = Vec3(0.8, 0.3, 0).normalized();
  EXPECT_NEAR(f.z(), 10, 1e-9);
  EXPECT_NEAR((f - Vec3(0, 0, 10) + 2.5 * along).norm(), 0, 1e-6);
}

TEST(Friction, neverMoreThanTheCoefficientTimesTheNormalForce) {
  const Loaded s =
      loadCollision(hand("0 10 30 50 70", "0 0 0.6  0 0 0.4  0.8 0.3 0.4  -0.4 0.3 0.45  0 0 0.4") +
                    probe + heldSurface(grid(1, 8)) + contact("stiffness='100' friction='0.25'"));
  double before = 0;
  for (int k = 0; k < 75; ++k) {
    s.run(1);
    const Vec3 f = toolOf(s).totalForce();
    // of the end of the step before: friction is lagged by one
    EXPECT_LE(f.head<2>().norm(), 0.25 * before + 1e-12);
    before = f.z();
  }
}

TEST(Friction, sticksWithoutCreep) {
  const Loaded s =
      loadCollision(hand("0 10 15", "0 0 0.6  0 0 0.4  0.01 0 0.4") + probe +
                    heldSurface(grid(1, 8)) + contact("stiffness='100' friction='0.25'"));
  s.run(16);
  const Vec3 first = toolOf(s).totalForce();
  EXPECT_NEAR(first.x(), -1, 1e-9) << "a spring of 100 N/m over 0.01 m, below the limit of 2.5 N";
  s.run(2000);
  EXPECT_NEAR((toolOf(s).totalForce() - first).norm(), 0, 1e-9);
}

// A plate, closed, 0.58 mm thick.
Surface plate() {
  Surface s = grid(10, 1e-3);
  const auto n = static_cast<Index>(s.x.size());
  const std::size_t top = s.triangles.size();
  for (Index i = 0; i < n; ++i)
    s.x.push_back(s.x[static_cast<std::size_t>(i)] - Vec3(0, 0, 0.58e-3));
  for (std::size_t t = 0; t < top; ++t) {
    const Triangle f = s.triangles[t];
    s.triangles.push_back({n + f[0], n + f[2], n + f[1]});
  }
  const auto wall = [&](Index a, Index b) {
    s.triangles.push_back({a, n + a, n + b});
    s.triangles.push_back({a, n + b, b});
  };
  for (Index i = 0; i < 10; ++i) {
    wall(i, i + 1);
    wall(120 - i, 119 - i);
    wall(11 * i + 10, 11 * i + 21);
    wall(11 * i + 11, 11 * i);
  }
  return s;
}

TEST(Tunnelling, theFastestToolDoesNotPassAThinPlate) {
  ASSERT_EQ(plate().x.size(), 242u);
  for (const double speed : {0.1, 1.0, 10.0, 50.0}) {  // m/s: 0.1 to 50 mm a step
    for (const std::string& tool :
         {needle, std::string("<ProbeTool name='probe' device='@hand' radius='0.1 mm'/>")}) {
      std::ostringstream path;
      path << "0.17e-3 0.31e-3 0.02  0.17e-3 0.31e-3 -0.02";
      const Loaded s = loadCollision(hand("0 " + std::to_string(40 / speed), path.str()) + tool +
                                     heldSurface(plate()) + contact("stiffness='100'"));
      EXPECT_TRUE(s.find<BVHCollisionModel>().closed());
      bool below = false;
      while (!below) {
        s.run(1);
        const double z = toolOf(s).pose().position.z();
        below = z < -1e-3;
        if (z >= 0 || z < -5e-3) continue;
        ASSERT_EQ(toolOf(s).contactCount, 1) << speed << " m/s at " << z;
        EXPECT_NEAR(toolOf(s).contacts()[0].normal.z(), 1, 1e-9) << "it came from above";
        EXPECT_NEAR(toolOf(s).contacts()[0].depth, toolOf(s).radius() - z, 1e-9);
      }
      EXPECT_GT(toolOf(s).totalForce().z(), 0);
      EXPECT_EQ(toolOf(s).contactCount, 1) << speed;
    }
  }
}

TEST(Tunnelling, teleportThroughThePlateIsHeldCappedAndCounted) {
  const Loaded s =
      loadCollision(hand("0 10 10.5 20 20.5 30",
                         "1.1e-3 0.3e-3 0.025  1.1e-3 0.3e-3 0.025  1.1e-3 0.3e-3 -0.025 "
                         " 1.1e-3 0.3e-3 -0.025  1.1e-3 0.3e-3 0.025  0 0 0.025") +
                    needle + heldSurface(plate()) + contact("stiffness='100' maxDepth='2 mm'"));
  const auto& field = s.find<PenaltyContactForceField>();
  s.run(10);
  EXPECT_EQ(toolOf(s).contactCount, 0);
  s.run(1);
  ASSERT_EQ(toolOf(s).contactCount, 1);
  EXPECT_NEAR(toolOf(s).totalForce().norm(), 0.2, 1e-12) << "100 N/m times 2 mm";
  EXPECT_GT(toolOf(s).totalForce().z(), 0.1);
  s.run(9);
  EXPECT_EQ(toolOf(s).contactCount, 1);
  EXPECT_EQ(limiter(field, "depthCapped"), 10u);
  s.run(2);
  EXPECT_EQ(toolOf(s).contactCount, 0) << "back in front it is free";
  EXPECT_EQ(toolOf(s).totalForce(), Vec3::Zero());
}

TEST(Tunnelling, aToolThatIsSetBeyondThePlateIsNotHeld) {
  for (const bool isSet : {false, true}) {
    const Loaded s =
        loadCollision("<ScalpelTool name='probe' length='1' sampleCount='1'/>" +
                      heldSurface(plate()) + contact("stiffness='100' maxDepth='2 mm'"));
    const auto move = [&](double z) {
      toolOf(s).moveTo({Vec3(1.1e-3, 0.3e-3, z), Quat::Identity()}, Vec3::Zero(), Vec3::Zero(),
                       false);
    };
    // near enough to be followed
    move(0.1e-3);
    s.run(1);
    move(-3e-3);
    if (isSet) move(-3e-3);
    s.run(1);
    EXPECT_EQ(toolOf(s).contactCount, isSet ? 0 : 1);
    move(-2.5e-3);
    s.run(1);
    EXPECT_EQ(toolOf(s).contactCount, isSet ? 0 : 1);
  }
}

TEST(Contact, anExplicitSolverIsAskedForItsSubsteps) {
  const auto text = [](const std::string& solver) {
    return loadCollision(hand("0", "0 0 9") + probe + solver + meshOf(grid(1, 4)) +
                         "<MechanicalObject name='nodes'/><UniformMass vertexMass='1'/>"
                         "<BVHCollisionModel name='collision'/>" +
                         contact("stiffness='1'"))
        .text();
  };
  EXPECT_NE(text("<EulerExplicitSolver/>").find("needs 'substeps'"), std::string::npos);
  EXPECT_EQ(text("<EulerExplicitSolver substeps='1'/>").find("'substeps'"), std::string::npos);
  EXPECT_EQ(text("<EulerImplicitSolver/><CGLinearSolver/>").find("'substeps'"), std::string::npos);
}

TEST(Tunnelling, aFastSurfaceDoesNotPassAStandingTool) {
  // an open sheet of free nodes that flies upwards at 2 m/s
  const Surface sheet = grid(2, 0.01);
  std::string velocity;
  for (std::size_t i = 0; i < sheet.x.size(); ++i) velocity += "0 0 2 ";
  const Loaded s =
      loadCollision(hand("0", "1e-3 2e-3 0.013") + needle + "<EulerExplicitSolver/>" +
                    meshOf(sheet) + "<MechanicalObject name='nodes' velocity='" + velocity +
                    "'/><UniformMass vertexMass='1'/><BVHCollisionModel name='collision'/>" +
                    contact("stiffness='1'"));
  s.run(6);
  EXPECT_EQ(toolOf(s).contactCount, 0);
  s.run(3);
  ASSERT_EQ(toolOf(s).contactCount, 1);
  EXPECT_NEAR(toolOf(s).contacts()[0].normal.z(), 1, 1e-3);
  EXPECT_NEAR(toolOf(s).contacts()[0].velocity.z(), 2, 1e-3);
}

TEST(Contact, behindAnOpenSheetNothingTouches) {
  const Loaded s = loadCollision(hand("0 10", "0 0.1 -0.6  0 0.1 0.3") + needle +
                                 heldSurface(grid(2, 1)) + contact("stiffness='100'"));
  for (int k = 0; k < 12; ++k) {
    s.run(1);
    EXPECT_EQ(toolOf(s).contactCount, 0) << toolOf(s).pose().position.z();
  }
}

TEST(Contact, aToolThatStartsInsideAClosedBodyIsPushedOut) {
  const Loaded s = loadCollision(hand("0", "0.2e-3 0.3e-3 -0.1e-3") + needle +
                                 heldSurface(plate()) + contact("stiffness='100'"));
  s.run(1);
  ASSERT_EQ(toolOf(s).contactCount, 1);
  EXPECT_NEAR(toolOf(s).totalForce().z(), 100 * 0.1e-3, 1e-12);
}

TEST(Contact, aCuttingToolTouchesNothing) {
  const Loaded s = loadCollision(hand("0 5", "0.4 -0.2 0.1  0.4 -0.2 -0.3") + needle +
                                 heldSurface(grid(1, 4)) + contact("stiffness='70'"));
  s.run(6);
  EXPECT_EQ(toolOf(s).contactCount, 1);
  toolOf(s).setCutting(true);
  s.run(1);
  EXPECT_EQ(toolOf(s).contactCount, 0);
}

TEST(Contact, dampingOpposesClosingAndNeverPulls) {
  const auto at = [](const std::string& more) {
    const Loaded s =
        loadCollision(hand("0 10 20", "0.4 -0.2 0.6  0.4 -0.2 0.4  0.4 -0.2 0.6") + probe +
                      heldSurface(grid(1, 4)) + contact("stiffness='100' " + more));
    std::vector<double> force;
    for (int k = 0; k < 20; ++k) {
      s.run(1);
      force.push_back(toolOf(s).totalForce().z());
    }
    return force;
  };
  const auto plain = at(""), damped = at("damping='0.2'");
  EXPECT_NEAR(damped[7] - plain[7], 0.2 * 20, 1e-9) << "closing at 20 m/s";
  for (const double f : damped) EXPECT_GE(f, 0);
  EXPECT_NEAR(damped[12], plain[12] - 4, 1e-9);
}

std::string pressing(const std::string& solver, double friction = 0.3,
                     const std::string& more = "") {
  Surface sheet = grid(6, 0.15);
  return hand("0 20 40", "0 0 0.55  0 0 0.4  0.05 0.02 0.4") + probe +
         softSurface(sheet, 20, solver) +
         contact("stiffness='200' friction='" + std::to_string(friction) + "'" + more);
}

TEST(Contact, linearStepsAndNewtonAgreeAtRest) {
  const Loaded a = loadCollision(pressing("newtonIterations='1'", 0)),
               b = loadCollision(pressing("newtonIterations='20'", 0));
  a.run(300);
  b.run(300);
  EXPECT_NEAR((toolOf(a).totalForce() - toolOf(b).totalForce()).norm(), 0,
              1e-3 * toolOf(b).totalForce().norm());
  EXPECT_EQ(limiter(b.find<EulerImplicitSolver>(), "notConverged"), 0u);
}

// With one linear solve a step the tissue follows a tool that draws back as Newton's has it.
TEST(Contact, drawingBackIsSmoothWithOneSolveAStep) {
  const auto forces = [](const std::string& solver) {
    const Loaded s = loadCollision(
        hand("0 20 100 400", "0.1 -0.05 0.05  0.1 -0.05 -0.1  0.1 -0.05 -0.1  0.1 -0.05 0.2") +
        needle + softSurface(grid(1, 0.6), 20, solver) + contact("stiffness='2000'"));
    std::vector<double> f;
    for (int k = 0; k < 400; ++k) {
      s.run(1);
      f.push_back(toolOf(s).totalForce().z());
    }
    return f;
  };
  const auto once = forces("newtonIterations='1'"), newton = forces("newtonIterations='20'");
  double largest = 0, apart = 0;
  for (std::size_t k = 100; k < newton.size(); ++k) {
    largest = std::max(largest, newton[k]);
    apart = std::max(apart, std::abs(once[k] - newton[k]));
  }
  EXPECT_LT(apart, 0.02 * largest);
  EXPECT_EQ(once.back(), 0);
  std::printf("drawing back: one solve a step is within %.2f %% of the largest force of Newton's\n",
              100 * apart / largest);
}

TEST_P(Response, checkpointContinuesWithTheSameBits) {
  const Loaded a = loadCollision(pressing("", 0.3, law())),
               b = loadCollision(pressing("", 0.3, law()));
  a.run(30);
  ASSERT_TRUE(b.scene->restore(a.scene->save()));
  a.run(30);
  b.run(30);
  EXPECT_EQ(a.scene->stateHash(), b.scene->stateHash());
  EXPECT_EQ(toolOf(a).totalForce(), toolOf(b).totalForce());
  EXPECT_GT(toolOf(a).contactCount, 0);
}

// The exact answer is where the tip is; a penalty of 200 N/m gives way by a quarter of the load.
TEST(Contact, constraintLeavesNoDepthUnderAToolThatRests) {
  for (const std::string solver : {"newtonIterations='1'", "newtonIterations='20'"}) {
    const auto at = [&](const std::string& response) {
      Loaded s = loadCollision(hand("0 20 200 400",
                                    "0.1 -0.05 0.05  0.1 -0.05 -0.1  0.1 -0.05 -0.1"
                                    "  0.1 -0.05 0.2") +
                               needle + softSurface(grid(1, 0.6), 20, solver) +
                               contact("stiffness='200' response='" + response + "'"));
      s.run(200);
      return s;
    };
    const Loaded penalty = at("penalty"), constraint = at("constraint");
    const double soft = penalty.find<PenaltyContactForceField>().depth,
                 hard = constraint.find<PenaltyContactForceField>().depth;
    EXPECT_GT(soft, 1e-2);
    EXPECT_LT(hard, 1e-9);
    EXPECT_GT(toolOf(constraint).totalForce().z(), toolOf(penalty).totalForce().z());
    EXPECT_NEAR((toolOf(constraint).totalForce() +
                 totalOn(constraint.find<PenaltyContactForceField>(), constraint.scene->time()))
                    .norm(),
                0, 1e-12);
    double deepest = 0;
    for (int k = 0; k < 200; ++k) {
      constraint.run(1);
      deepest = std::max<double>(deepest, constraint.find<PenaltyContactForceField>().depth);
      // one solve a step may pull for a step: k times the tool's way at most
      const double pull = solver == "newtonIterations='1'" ? 200 * 0.3 / 200 : 0;
      EXPECT_GE(toolOf(constraint).totalForce().z(), -pull);
    }
    EXPECT_LT(deepest, 1e-3);
    EXPECT_EQ(toolOf(constraint).totalForce(), Vec3::Zero());
    std::printf("depth at rest: penalty %.1e, constraint %.1e; drawing back %.1e m\n", soft, hard,
                deepest);
  }
}

TEST(Contact, anyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    const Loaded s = loadCollision(pressing(""));
    s.run(50);
    hashes.push_back(s.scene->stateHash());
  }
  setThreadCount(1);
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Contact, resetStartsAnew) {
  const Loaded s = loadCollision(pressing(""));
  s.run(50);
  const std::uint64_t hash = s.scene->stateHash();
  s.scene->reset();
  s.run(50);
  EXPECT_EQ(hash, s.scene->stateHash());
}

TEST(CollisionModel, followsAChangeOfTheTopology) {
  const Loaded s = loadCollision(hand("0 5", "0.4 -0.2 0.1  0.4 -0.2 -0.3") + needle +
                                 heldSurface(grid(1, 4)) + contact("stiffness='70'"));
  s.run(6);
  EXPECT_EQ(toolOf(s).contactCount, 1);
  // the triangle under the needle goes
  auto& mesh = s.find<WrittenMesh>();
  std::vector<Triangle> triangles = mesh.triangle;
  const Index touched = toolOf(s).contacts()[0].triangle;
  triangles[static_cast<std::size_t>(touched)] = {0, 0, 0};
  mesh.triangle.set(triangles);
  SurfaceEdit edit;
  edit.firstNewNode = s.find<MechanicalObject>().size();
  edit.firstNewTriangle = static_cast<Index>(triangles.size());
  edit.changed = {{touched, {0, 0, 0}}};
  auto& nodes = s.find<MechanicalObject>();
  s.find<BVHCollisionModel>().topologyChanged({nodes, nodes, mesh, edit, NoBarrier()});
  s.run(1);
  EXPECT_EQ(toolOf(s).contactCount, 0);
  // the whole surface is back after a reset
  mesh.triangle.set(grid(1, 4).triangles);
  s.find<BVHCollisionModel>().topologyRestored();
  s.scene->reset();
  s.run(6);
  EXPECT_EQ(toolOf(s).contactCount, 1);
}

TEST(CollisionModel, costsLittleWhileToolsAreFar) {
  const Surface cornea = readSurface(std::string(STROMA_MESHES) + "/cornea_shell.obj");
  const Loaded s = loadCollision(hand("0", "0 0 0.05") +
                                 "<ScalpelTool name='probe' device='@hand' length='1 mm'/>" +
                                 heldSurface(cornea) + contact("stiffness='70'"));
  s.scene->profiler().setEnabled(true);
  s.run(500);
  for (const auto& row : s.scene->profiler().rows(static_cast<int>(Stage::Collide))) {
    std::printf("tool far from %zu triangles: %s %.4f ms a step (median)\n",
                cornea.triangles.size(), row.label.c_str(), row.timer.percentileMs(0.5));
    EXPECT_LT(row.timer.percentileMs(0.5), 0.02);
  }
}

TEST(Collision, mistakesAreNamed) {
  const std::string sheet = heldSurface(grid(1, 4)), start = hand("0", "0 0 9") + probe;
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {start + sheet + contact(""), "stiffness"},
      {start + sheet + contact("stiffness='0'"), "greater than 0"},
      {start + sheet + contact("stiffness='1' friction='-1'"), "friction"},
      {sheet + contact("stiffness='1'"), "probe"},
      {start + sheet + "<PenaltyContactForceField stiffness='1'/>", "tools"},
      {start + sheet + contact("stiffness='1'") +
           "<PenaltyContactForceField tools='@probe' stiffness='1'/>",
       "has its contacts from '/contact' already"},
      {start + "<EulerImplicitSolver/><CGLinearSolver/><WrittenMesh name='mesh'/>"
               "<MechanicalObject position='0 0 0'/><UniformMass vertexMass='1'/>"
               "<BVHCollisionModel/>",
       "has no triangles"},
      {start + "<EulerImplicitSolver/><CGLinearSolver/>" + meshOf(grid(1, 4)) +
           "<MechanicalObject position='0 0 0'/><UniformMass vertexMass='1'/>"
           "<BVHCollisionModel/>",
       "a triangle has node"},
      {start + sheet + "<GripContact tool='@probe'/>", "stiffness"}};
  for (const auto& [content, expected] : mistakes) {
    const Loaded s = tryCollision(content);
    EXPECT_FALSE(s.ready) << content;
    EXPECT_NE(s.text().find(expected), std::string::npos) << content << "\n" << s.text();
  }
}

}  // namespace
}  // namespace stroma::test
