// SPDX-License-Identifier: Apache-2.0
// What must hold of point-based mechanics in a body that has been cut.
#include <random>

#include "core/parallel.h"
#include "tests/components/mechanics/cut_scene.h"

namespace stroma::test {
namespace {

constexpr double youngModulus = 1000;

std::string ellipsoids() {
  std::string normals;
  for (int i = 0; i < 729; ++i) normals += "0 0 1 ";
  return "supportShape=\"ellipsoid\" spacing=\"1\" layerSpacing=\"1.2\" "
         "gradient=\"consistent\" normal=\"" +
         normals + "\"";
}

struct Scheme {
  std::string name, attributes;
};
const std::vector<Scheme> schemes = {
    {"plain", "gradient=\"plain\""},
    {"consistent", "gradient=\"consistent\""},
    {"second order", "gradient=\"secondOrder\""},
    {"by radius", "supportSpacings=\"1.7\" gradient=\"consistent\""},
    {"ellipsoids", ellipsoids()}};

std::vector<Vec3> moved(ConstVec3Span X, const Mat3& A, const Vec3& t) {
  std::vector<Vec3> x(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) x[i] = A * X[i] + t;
  return x;
}

Mat3 affine() {
  Mat3 A;
  A << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
  return A;
}

double largest(ConstVec3Span f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, v.norm());
  return most;
}

// Cauchy stress F S F^T / J of that motion, S = 2 mu E + lambda tr(E) I, E = (F^T F - I) / 2.
Mat3 affineStress() {
  const double nu = 0.3, mu = youngModulus / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu);
  const Mat3 F = affine(), E = 0.5 * (F.transpose() * F - Mat3::Identity());
  const Mat3 S = 2 * mu * E + lambda * E.trace() * Mat3::Identity();
  return F * S * F.transpose() / F.determinant();
}

// A slit, half way down and between the sides, and across it another one.
void cutTwice(CutScene& body, const std::array<Index, 3>& n) {
  body.cut(slit(n, 0.5 * n[0] + 0.13, 0.2, 2.2, n[1] - 2.3, 0.5 * n[2]));
  body.cut(slit(n, 0.3 * n[0], -0.1, -0.5, 0.6 * n[1], 0.7 * n[2]));
}

void cutInTwo(CutScene& body, const std::array<Index, 3>& n) {
  body.cut(slit(n, 0.5 * n[0] + 0.13, 0.15, -0.5, n[1] + 0.5, n[2] + 0.5));
}

TEST(CutBody, keepsNoLinkAcrossACutAndEverythingFits) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes;
    CutScene body(options);
    EXPECT_TRUE(body.check().failures.empty());
    std::vector<std::size_t> before;
    for (Index i = 0; i < body.particles->size(); ++i)
      before.push_back(body.field->neighbourhoods().neighboursOf(i).size());
    cutTwice(body, options.n);
    const TopologyCheck check = body.check();
    for (const std::string& failure : check.failures) ADD_FAILURE() << failure;
    std::printf("%s: %d changes, %d nodes, %d facets, %d free chips (%llu, %llu)\n", scheme.c_str(),
                body.changes, body.nodes->size(), body.barrier.count(), check.freeChips,
                static_cast<unsigned long long>(body.field->freeChips.count()),
                static_cast<unsigned long long>(body.mapping->freeChips.count()));
    EXPECT_GT(body.changes, 10);
    EXPECT_EQ(check.freeChips, 0);

    // brute force, without the search grid
    const Neighbourhoods& n = body.field->neighbourhoods();
    const ConstVec3Span X = body.particles->rest();
    for (Index i = 0; i < n.particleCount(); ++i) {
      EXPECT_GE(n.neighboursOf(i).size(), std::min<std::size_t>(8, before[i]));
      for (const Index j : n.neighboursOf(i))
        EXPECT_FALSE(body.barrier.crossesBruteForce(X[i], X[j]));
    }
  }
}

TEST(CutBody, staysAtRestAndSeesAffineMotionsExactly) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes + " strain=\"green\"";
    CutScene body(options);
    cutTwice(body, options.n);
    const ConstVec3Span X = body.particles->rest();
    const double atRest = largest(body.forces(X)) / youngModulus;
    const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const double turned = largest(body.forces(moved(X, turn, Vec3(1, 2, 3)))) / youngModulus;

    const std::vector<Vec3> x = moved(X, affine(), Vec3(1, 2, 3));
    const StateView view{x, x, 0};
    const Mat3 expected = affineStress();
    double stress = 0;
    for (Index i = 0; i < body.particles->size(); ++i)
      stress = std::max(stress, (body.field->stressAt(view, i) - expected).norm());
    std::vector<Vec3> at(static_cast<std::size_t>(body.nodes->size()));
    body.mapping->apply(x, at);
    const std::vector<Vec3> where = moved(body.nodes->rest(), affine(), Vec3(1, 2, 3));
    double node = 0;
    for (std::size_t s = 0; s < at.size(); ++s) node = std::max(node, (at[s] - where[s]).norm());
    std::printf("%s: force at rest %.1e, turned %.1e E s^2; stress %.1e; nodes %.1e\n",
                scheme.c_str(), atRest, turned, stress / expected.norm(), node);
    EXPECT_LT(atRest, 1e-10);
    EXPECT_LT(turned, 1e-10);
    EXPECT_LT(stress, 1e-10 * expected.norm());
    EXPECT_LT(node, 1e-11);
  }
}

TEST(CutBody, balancesItselfAndItsForceIsMinusTheEnergyGradient) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes;
    options.more = "<VolumeConstraint stiffness=\"300\"/>";
    CutScene body(options);
    cutTwice(body, options.n);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    const auto noise = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    std::vector<Vec3> x = moved(body.particles->rest(), affine(), Vec3::Zero()), d(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += noise();
      d[i] = noise();
    }
    for (ForceField* field : collect<ForceField>(body.scene.root())) {
      std::vector<Vec3> f(x.size(), Vec3::Zero());
      field->addForce({x, x, 0}, f);
      Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
      double size = 0, slope = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        force += f[i];
        torque += x[i].cross(f[i]);
        size += f[i].norm();
        slope += f[i].dot(d[i]);
      }
      const auto at = [&](double h) {
        std::vector<Vec3> y(x);
        for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * d[i];
        return field->potentialEnergy({y, y, 0});
      };
      const double h = 1e-3;
      const double difference = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
      std::printf("%s: force %.1e, torque %.1e, energy slope %.1e\n", scheme.c_str(),
                  force.norm() / size, torque.norm() / size, std::abs(difference / slope + 1));
      EXPECT_LT(force.norm(), 1e-12 * size);
      EXPECT_LT(torque.norm(), 1e-11 * size);
      EXPECT_NEAR(difference, -slope, 1e-7 * std::abs(slope));
    }
  }
}

// Products with the stiffness, and its blocks, are those of the force after the cut.
TEST(CutBody, stiffnessIsTheForceDerivative) {
  CutSceneOptions options;
  options.n = {6, 6, 6};
  options.force += " tangent=\"exact\"";
  CutScene body(options);
  cutInTwo(body, options.n);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  const auto noise = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  std::vector<Vec3> x(body.particles->rest().begin(), body.particles->rest().end()), d(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] += noise();
    d[i] = noise();
  }
  body.field->linearize({x, x, 0});
  std::vector<Vec3> product(x.size(), Vec3::Zero()), difference(x.size(), Vec3::Zero());
  body.field->addTangentProduct(d, 1, 0, product);
  const double h = 1e-4;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3> y(x);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += side * h * d[i];
    const std::vector<Vec3> f = body.forces(y);
    for (std::size_t i = 0; i < f.size(); ++i) difference[i] += side * f[i] / (2 * h);
  }
  flat(Vec3Span(difference)) -= flat(Vec3Span(product));
  EXPECT_LT(flat(Vec3Span(difference)).norm(), 1e-6 * flat(Vec3Span(product)).norm());
}

// The particles that can be reached from the first one over links.
std::vector<char> reachedFromFirst(const Neighbourhoods& n) {
  std::vector<char> reached(n.rows.size(), 0);
  reached[0] = 1;
  for (bool grown = true; grown;) {
    grown = false;
    for (Index i = 0; i < n.particleCount(); ++i)
      for (const Index j : n.neighboursOf(i))
        if (reached[i] != reached[j]) reached[i] = reached[j] = grown = true;
  }
  return reached;
}

TEST(CutBody, halvesThatAreCutApartDoNotFeelEachOther) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes;
    CutScene body(options);
    cutInTwo(body, options.n);
    EXPECT_TRUE(body.check().failures.empty());
    Index pieces = 0;
    static_cast<void>(body.complex->pieces(pieces));
    ASSERT_EQ(pieces, 2);

    const ConstVec3Span X = body.particles->rest();
    const auto isLeft = [&](const Vec3& p) { return p.x() < 4.63 + 0.15 * (p.z() - 4.5); };
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 0, 2).normalized()).toRotationMatrix();
    std::vector<Vec3> x(X.begin(), X.end());
    const std::vector<char> reached = reachedFromFirst(body.field->neighbourhoods());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (reached[i]) x[i] = turn * x[i] + Vec3(-3, 1, 0);
      const double off = X[i].x() - 4.63 - 0.15 * (X[i].z() - 4.5);
      if (std::abs(off) > 0.2) {
        EXPECT_EQ(reached[i] != 0, off < 0);
      }
    }
    const double force = largest(body.forces(x)) / youngModulus;

    std::vector<Vec3> at(static_cast<std::size_t>(body.nodes->size()));
    body.mapping->apply(x, at);
    double node = 0;
    Index left = 0, seam = 0;
    for (std::size_t s = 0; s < at.size(); ++s) {
      const Vec3 rest = body.nodes->rest()[s], other = turn * rest + Vec3(-3, 1, 0);
      const double stays = (at[s] - rest).norm(), goes = (at[s] - other).norm();
      node = std::max(node, std::min(stays, goes));
      left += goes < stays;
      // away from the cut a node is on the side where it lies
      const bool onCut = std::abs(rest.x() - 4.63 - 0.15 * (rest.z() - 4.5)) < 0.3;
      seam += onCut;
      if (!onCut) {
        EXPECT_EQ(goes < stays, isLeft(rest));
      }
    }
    std::printf("%s: force %.1e E s^2, nodes %.1e, %d of %zu nodes go, %d at the cut\n",
                scheme.c_str(), force, node, left, at.size(), seam);
    EXPECT_LT(force, 1e-10);
    EXPECT_LT(node, 1e-10);
  }
}

TEST(CutBody, isAsBeforeOnceRestoredAndCutsTheSameAgain) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes;
    CutScene body(options);
    std::vector<Vec3> x = moved(body.particles->rest(), affine(), Vec3::Zero());
    std::vector<Vec3> restBefore(body.nodes->rest().begin(), body.nodes->rest().end());
    const auto nodesAt = [&] {
      std::vector<Vec3> at(static_cast<std::size_t>(body.nodes->size()));
      body.mapping->apply(x, at);
      return at;
    };
    const MlsBonds* bonds = &body.field->bonds();
    const auto whole = body.forces(x);
    const auto wholeNodes = nodesAt();
    cutTwice(body, options.n);
    const auto cutForces = body.forces(x);
    const auto cutNodes = nodesAt();
    EXPECT_NE(whole, cutForces);
    const int threads = threadCount();
    for (const int count : {1, 3}) {
      setThreadCount(count);
      body.scene.reset();
      body.makeWhole(options.n);
      EXPECT_EQ(bonds, &body.field->bonds());
      EXPECT_EQ(body.forces(x), whole);
      EXPECT_EQ(nodesAt(), wholeNodes);
      cutTwice(body, options.n);
      EXPECT_EQ(body.forces(x), cutForces);
      EXPECT_EQ(nodesAt(), cutNodes);
      EXPECT_TRUE(body.check().failures.empty());
    }
    setThreadCount(threads);
    // parameters may change in a body that is cut
    ASSERT_FALSE(body.scene.setAttribute("/field.youngModulus", "2000"));
    const auto stiffer = body.forces(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_LT((stiffer[i] - 2 * cutForces[i]).norm(), 1e-6 * (1 + cutForces[i].norm()));
    EXPECT_TRUE(body.check().failures.empty());
  }
}

// A mapping that is asked for the same again does not compute it again; whatever has changed, a
// cut or the body made whole included, it must.
TEST(CutBody, itsNodesAreWhereItsShapeSaysAlsoWhenAskedAgain) {
  CutSceneOptions options;
  CutScene body(options);
  std::vector<Vec3> x = moved(body.particles->rest(), affine(), Vec3::Zero());
  const auto expectNow = [&](const char* when) {
    const Vec3Span out = body.nodes->x(), velocities = body.nodes->v();
    std::vector<Vec3> fresh(out.size());
    body.mapping->shape().apply(x, fresh);
    for (int again = 0; again < 2; ++again) {
      body.mapping->apply(x, out);
      body.mapping->applyJ(x, velocities);
      EXPECT_TRUE(std::ranges::equal(out, fresh)) << when;
      EXPECT_TRUE(std::ranges::equal(velocities, fresh)) << when;
    }
  };
  expectNow("at first");
  x[5].y() += 1e-3;
  expectNow("one particle moved");
  cutTwice(body, options.n);
  expectNow("cut");
  body.scene.reset();
  body.makeWhole(options.n);
  expectNow("whole again");
}

// The stiffness of a volume constraint is what it is now, to the bit, however it came there.
TEST(CutBody, itsVolumeConstraintFollowsChanges) {
  const auto forcesWith = [](const std::string& constraint,
                             const std::vector<std::string>& changes) {
    CutSceneOptions options;
    options.more = constraint;
    CutScene body(options);
    for (const std::string& value : changes) {
      const auto problem = body.scene.setAttribute("/volume.stiffness", value);
      EXPECT_FALSE(problem) << *problem;
    }
    return body.forces(moved(body.particles->rest(), affine(), Vec3::Zero()));
  };
  const std::string soft = R"(<VolumeConstraint name="volume" stiffness="0.3"/>)";
  const auto none = forcesWith("", {});
  EXPECT_NE(forcesWith(soft, {}), none);
  EXPECT_EQ(forcesWith(R"(<VolumeConstraint name="volume" stiffness="1e4"/>)", {"0.3"}),
            forcesWith(soft, {}));
  EXPECT_EQ(forcesWith(soft, {"1e4", "0.7", "0"}), none);
}

// What is cut is an open sheet on top of the particles, not the surface that encloses them.
TEST(CutBody, followsCutsOfASheetOnTop) {
  CutSceneOptions options;
  options.sheet = true;
  options.force += " strain=\"green\"";
  CutScene body(options);
  cutTwice(body, options.n);
  EXPECT_GT(body.changes, 0);
  const TopologyCheck check = body.check();
  for (const std::string& failure : check.failures) ADD_FAILURE() << failure;
  EXPECT_FALSE(body.field->cutProjectionReport());
  const Neighbourhoods& n = body.field->neighbourhoods();
  const ConstVec3Span X = body.particles->rest();
  for (Index i = 0; i < n.particleCount(); ++i)
    for (const Index j : n.neighboursOf(i))
      EXPECT_FALSE(body.barrier.crossesBruteForce(X[i], X[j]));
  EXPECT_GT(body.field->cutParticles().relinked.size(), 0u);
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LT(largest(body.forces(moved(X, turn, Vec3(1, 2, 3)))), 1e-10 * youngModulus);
}

// Other points that ride on the same particles follow too, though none of theirs are new: a twin of
// the surface that is cut, and one carried by fewer particles.
TEST(CutBody, otherPointsOnItsParticlesFollow) {
  CutSceneOptions options;
  options.more =
      "<Node name=\"twin\"><CutSurface "
      "body=\"@../sampler\"/><MechanicalObject/><MLSMapping/></Node>"
      "<Node name=\"few\"><CutSurface body=\"@../sampler\"/><MechanicalObject/>"
      "<MLSMapping supportCount=\"4\"/></Node>";
  options.mapping = "supportCount=\"10\"";
  for (const char* mapping : {"", "supportCount=\"10\""}) {
    options.mapping = mapping;
    CutScene body(options);
    const Index count = body.nodes->size();
    cutInTwo(body, options.n);
    const TopologyCheck check = body.check();
    for (const std::string& failure : check.failures) ADD_FAILURE() << failure;
    for (const MLSMapping* m : collect<MLSMapping>(body.scene.root()))
      EXPECT_EQ(m->shape().pointCount(), m == body.mapping ? body.nodes->size() : count);
    body.scene.reset();
    EXPECT_EQ(body.mapping->shape().pointCount(), count);
  }
}

// New nodes lie where the particles have carried them, at their velocity, however deformed.
TEST(CutBody, newNodesAppearWhereTheDeformedBodyIs) {
  CutScene body({});
  const std::vector<Vec3> x = moved(body.particles->rest(), affine(), Vec3(1, 2, 3));
  std::ranges::copy(x, body.particles->x().begin());
  const std::vector<Vec3> v = moved(body.particles->rest(), Mat3::Zero(), Vec3(1, 0, 2));
  std::ranges::copy(v, body.particles->v().begin());
  const Index before = body.nodes->size();
  body.apply = [&](const TopologyChange& change) {
    body.scene.changeTopology(change);
    for (const TouchedNode& touched : change.edit.touched) {
      const Vec3 where = affine() * body.nodes->rest()[touched.node] + Vec3(1, 2, 3);
      EXPECT_LT((body.nodes->x()[touched.node] - where).norm(), 1e-10);
      EXPECT_LT((body.nodes->v()[touched.node] - Vec3(1, 0, 2)).norm(), 1e-10);
    }
  };
  cutTwice(body, {9, 9, 9});
  EXPECT_GT(body.nodes->size(), before);
}

// A piece smaller than a neighbourhood: what it lacks is counted, and nothing fails.
TEST(CutBody, countsTheParticlesOfAFreeChip) {
  for (const std::size_t k0 : {0U, 1U, 3U}) {
    const auto& [scheme, attributes] = schemes[k0];
    CutSceneOptions options;
    options.force = attributes;
    options.mapping = "supportCount=\"12\"";
    CutScene body(options);
    // a corner of about two by two by nine particles, and its upper part
    body.cut(slit(options.n, 1.3, 0, -0.5, 2.6, 9.5));
    std::vector<CutScene::Pose> across, level;
    for (int k = 0; k <= 8; ++k) {
      across.push_back({Vec3(-0.5, 1.4, 9.5 - 1.25 * k), Vec3(2.4, 1.4, 9.5 - 1.25 * k)});
      level.push_back({Vec3(-0.5, -0.5 + 0.4 * k, 7.3), Vec3(2.4, -0.5 + 0.4 * k, 7.3)});
    }
    body.cut(across);
    body.cut(level);
    const TopologyCheck check = body.check();
    for (const std::string& failure : check.failures) ADD_FAILURE() << failure;
    const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const double force =
        largest(body.forces(moved(body.particles->rest(), turn, Vec3(1, 2, 3)))) / youngModulus;
    std::printf("%s: %d free chips, %llu particles and %llu nodes; force when turned %.1e E s^2\n",
                scheme.c_str(), check.freeChips,
                static_cast<unsigned long long>(body.field->freeChips.count()),
                static_cast<unsigned long long>(body.mapping->freeChips.count()), force);
    EXPECT_GT(body.field->freeChips.count(), 0u);
    EXPECT_GT(body.mapping->freeChips.count(), 0u);
    EXPECT_LT(force, 1e-10);
  }
}

TEST(CutBody, localProjectionBringsBackConsistency) {
  for (const int iterations : {0, 4, 8, 16}) {
    CutSceneOptions options;
    options.force += " projectionIterations=\"" + std::to_string(iterations) + "\"";
    CutScene body(options);
    double worst = 0;
    body.apply = [&](const TopologyChange& change) {
      body.scene.changeTopology(change);
      const ProjectionReport* report = body.field->cutProjectionReport();
      if (report) worst = std::max(worst, report->residualAfter / report->residualBefore);
    };
    cutTwice(body, options.n);
    const ProjectionReport* last = body.field->cutProjectionReport();
    ASSERT_TRUE(last);
    std::printf("%d iterations: residual of the last change %.4f -> %.4f, worst ratio %.3f\n",
                iterations, last->residualBefore, last->residualAfter, worst);
    EXPECT_LT(worst, 0.7);
  }
}

// A stretched body loses energy to a cut that opens it; what a change adds must be nothing much.
TEST(CutBody, energyOfAStretchedBodyBeforeAndAfterACut) {
  for (const auto& [scheme, attributes] : schemes) {
    CutSceneOptions options;
    options.force = attributes;
    CutScene body(options);
    Mat3 stretch = Mat3::Identity();
    stretch(0, 0) = 1.1;
    std::vector<Vec3> x = moved(body.particles->rest(), stretch, Vec3::Zero());
    for (Vec3& p : x) p.z() += 0.05 * std::sin(p.x());
    const double before = body.energy(x);
    cutTwice(body, options.n);
    const double after = body.energy(x);
    std::printf("%s: energy changes by %+.2e of itself\n", scheme.c_str(), after / before - 1);
    EXPECT_LT(std::abs(after / before - 1), 0.02);
  }
}

}  // namespace
}  // namespace stroma::test
