// SPDX-License-Identifier: Apache-2.0
// Laws that hold for every element and every material.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/neo_hookean.h"
#include "components/material/stable_neo_hookean.h"
#include "tests/components/fem/element_body.h"

namespace stroma::test {
namespace {

constexpr double youngModulus = 1000, poissonRatio = 0.3;

template <class E, class M>
struct Kind {
  using Element = E;
  using Material = M;
  static constexpr bool blindToRotation = !std::is_same_v<M, HookeCauchy>;
};

template <class K>
class Elements : public testing::Test {
 public:
  using Element = typename K::Element;
  using Material = typename K::Material;
  using Elasticity = ElementElasticity<Element, Material>;

  Body<Element> block{{3, 3, 3}};
  Elasticity elasticity{Material(youngModulus, poissonRatio), block.mesh};
  // turned far and strained
  Mat3 strain = (Mat3() << 1.1, 0.2, 0, -0.1, 0.95, 0.1, 0.05, 0, 0.9).finished();
  std::vector<Vec3> pose = block.moved(rotation(2.2, {1, -2, 0.5}) * strain, 0.05);

  std::vector<Vec3> force(ConstVec3Span at) {
    std::vector<Vec3> f(at.size(), Vec3::Zero());
    elasticity.addForces(at, f);
    return f;
  }
  std::vector<Vec3> product(ConstVec3Span dx) {
    std::vector<Vec3> df(dx.size(), Vec3::Zero());
    elasticity.addStiffnessProduct(1, dx, df);
    return df;
  }
  std::vector<Vec3> along(ConstVec3Span d, double h) const {
    std::vector<Vec3> out(pose);
    flat(Vec3Span(out)) += h * flat(d);
    return out;
  }
};

using Kinds = testing::Types<
    Kind<LinearTetrahedron, HookeCauchy>, Kind<LinearTetrahedron, HookeCorotated>,
    Kind<LinearTetrahedron, HookeGreen>, Kind<LinearTetrahedron, NeoHookean>,
    Kind<LinearTetrahedron, StableNeoHookean>, Kind<TrilinearHexahedron, HookeCauchy>,
    Kind<TrilinearHexahedron, HookeCorotated>, Kind<TrilinearHexahedron, HookeGreen>,
    Kind<TrilinearHexahedron, NeoHookean>, Kind<TrilinearHexahedron, StableNeoHookean>>;
TYPED_TEST_SUITE(Elements, Kinds);

TYPED_TEST(Elements, affineMotionHasItsStressAndLeavesNodesInsideAlone) {
  const auto& body = this->block;
  const Mat3& A = this->strain;
  const std::vector<Vec3> x = body.moved(A, 0), f = this->force(x);
  const Mat3 expected = this->elasticity.material().stress(A) * A.transpose() / A.determinant();
  double gradient = 0, stress = 0, inside = 0;
  for (Index e = 0; e < body.mesh.elementCount(); ++e)
    for (int q = 0; q < TypeParam::Element::points; ++q)
      gradient = std::max(gradient, (this->elasticity.gradientAt(e, q, x) - A).norm());
  for (Index i = 0; i < body.mesh.nodeCount(); ++i) {
    const auto at = this->elasticity.stressAt(x, i);
    stress = std::max(stress, (at.stress - expected).norm() / expected.norm());
    EXPECT_NEAR(at.volumeRatio, A.determinant(), 1e-12);
    if (body.inside[i]) inside = std::max(inside, f[i].norm() / youngModulus);
  }
  std::printf("affine motion: gradient %.1e, stress %.1e of it, force inside %.1e E h^2\n",
              gradient, stress, inside);
  EXPECT_LT(gradient, 1e-12);
  EXPECT_LT(stress, 1e-12);
  EXPECT_LT(inside, 1e-12);
}

TYPED_TEST(Elements, forceIsMinusEnergyGradient) {
  const std::vector<Vec3> d = randomField(this->pose.size(), 1, 5), f = this->force(this->pose);
  const double h = 1e-5;
  const double slope =
      (this->elasticity.energy(this->along(d, h)) - this->elasticity.energy(this->along(d, -h))) /
      (2 * h);
  const double work = flat(ConstVec3Span(f)).dot(flat(ConstVec3Span(d)));
  std::printf("energy slope against force: %.1e\n", std::abs(slope / work + 1));
  EXPECT_NEAR(slope / work, -1, 1e-7);
}

TYPED_TEST(Elements, tangentIsDerivativeOfForce) {
  const std::vector<Vec3> d = randomField(this->pose.size(), 1, 6);
  this->elasticity.prepareTangent(this->pose, TangentKind::exact);
  const std::vector<Vec3> Kd = this->product(d);
  const double h = 1e-5;
  const std::vector<Vec3> more = this->force(this->along(d, h)),
                          less = this->force(this->along(d, -h));
  double error = 0;
  for (std::size_t i = 0; i < d.size(); ++i)
    error += ((more[i] - less[i]) / (2 * h) + Kd[i]).squaredNorm();
  std::printf("derivative of the force: %.1e\n", std::sqrt(error) / norm(Kd));
  EXPECT_LT(std::sqrt(error), 1e-6 * norm(Kd));
}

TYPED_TEST(Elements, filteredTangentIsPositive) {
  // crushed to 45 % and sheared: several laws have lost their stability
  Mat3 crush = Vec3(0.45, 0.9, 1.0).asDiagonal();
  crush(0, 1) = 0.4;
  const std::vector<Vec3> x = this->block.moved(rotation(1, {1, 1, 0}) * crush, 0.02);
  const auto size = static_cast<Eigen::Index>(3 * x.size());
  for (const TangentKind form : {TangentKind::exact, TangentKind::filtered}) {
    this->elasticity.prepareTangent(x, form);
    Eigen::MatrixXd K(size, size);
    std::vector<Vec3> unit(x.size(), Vec3::Zero());
    for (Eigen::Index c = 0; c < size; ++c) {
      flat(Vec3Span(unit))[c] = 1;
      const std::vector<Vec3> column = this->product(unit);
      K.col(c) = flat(ConstVec3Span(column));
      flat(Vec3Span(unit))[c] = 0;
    }
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
    const double largest = values.maxCoeff(), smallest = values.minCoeff() / largest;
    std::printf("%s: smallest eigenvalue %.1e of the largest, asymmetry %.1e\n",
                form == TangentKind::exact ? "exact" : "filtered", smallest,
                (K - K.transpose()).norm() / K.norm());
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
    if (form == TangentKind::filtered) {
      EXPECT_GT(smallest, -1e-12);
    }
  }
}

TYPED_TEST(Elements, keepMomenta) {
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0, lever = 0;
  const std::vector<Vec3> f = this->force(this->pose);
  for (std::size_t i = 0; i < f.size(); ++i) {
    sum += f[i];
    torque += this->pose[i].cross(f[i]);
    size += f[i].norm();
    lever += this->pose[i].norm() * f[i].norm();
  }
  std::printf("resultant %.1e, torque %.1e\n", sum.norm() / size, torque.norm() / lever);
  EXPECT_LT(sum.norm(), 1e-14 * size);
  if (TypeParam::blindToRotation) {
    EXPECT_LT(torque.norm(), 1e-13 * lever);
  }
}

TYPED_TEST(Elements, turningTwiceRoundTakesNoForceUnlessStrainIsCauchys) {
  double worst = 0;
  for (int k = 0; k <= 32; ++k) {
    const Mat3 R = rotation(k * 4 * M_PI / 32, {1, 2, -1});
    worst = std::max(worst, norm(this->force(this->block.moved(R, 0))) / youngModulus);
  }
  std::printf("720 degrees: largest force %.1e E h^2\n", worst);
  if (TypeParam::blindToRotation) {
    EXPECT_LT(worst, 1e-12);
  } else {
    EXPECT_GT(worst, 1);
  }
}

TYPED_TEST(Elements, blocksEqualProducts) {
  const auto count = static_cast<Index>(this->pose.size());
  const Index offset = 2;
  this->elasticity.prepareTangent(this->pose, TangentKind::filtered);
  BlockPattern pattern(count + offset);
  this->elasticity.stiffness().addPattern(pattern, offset);
  BlockMatrix matrix(std::move(pattern));
  this->elasticity.stiffness().addTo(matrix, offset, -2.5);
  const std::vector<Vec3> d = randomField(this->pose.size(), 1, 7), Kd = this->product(d);
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(3 * (count + offset));
  padded.tail(3 * count) = flat(ConstVec3Span(d));
  const Eigen::VectorXd y = matrix.lower().selfadjointView<Eigen::Lower>() * padded;
  EXPECT_LT((y.tail(3 * count) + 2.5 * flat(ConstVec3Span(Kd))).norm(), 1e-13 * norm(Kd));
  EXPECT_EQ(y.head(3 * offset).norm(), 0);
}

TYPED_TEST(Elements, bitsDoNotDependOnThreads) {
  Body<typename TypeParam::Element> body({9, 9, 9});
  const typename TypeParam::Material material(youngModulus, poissonRatio);
  ElementElasticity<typename TypeParam::Element, typename TypeParam::Material> loops(material,
                                                                                     body.mesh);
  const std::vector<Vec3> x = body.moved(this->strain, 0.05);
  std::vector<Vec3> f[2], df[2];
  double energy[2];
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    const int k = threads - 1;
    f[k].assign(x.size(), Vec3::Zero());
    df[k] = f[k];
    loops.addForces(x, f[k]);
    energy[k] = loops.energy(x);
    loops.prepareTangent(x, TangentKind::filtered);
    loops.addStiffnessProduct(1, f[k], df[k]);
  }
  setThreadCount(1);
  EXPECT_EQ(f[0], f[1]);
  EXPECT_EQ(df[0], df[1]);
  EXPECT_EQ(energy[0], energy[1]);
}

TEST(ElementMesh, findsInvertedAndFlatElements) {
  const std::vector<Vec3> X{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  const std::vector<Tetrahedron> good{{0, 1, 2, 3}}, bad{{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 2, 4}};
  EXPECT_EQ(ElementMesh<LinearTetrahedron>::findFlaw(X, good).count, 0);
  EXPECT_EQ(ElementMesh<LinearTetrahedron>::findFlaw(X, bad).count, 2);
  EXPECT_EQ(ElementMesh<LinearTetrahedron>::findFlaw(X, bad).first, 1);
  std::vector<Vec3> cube = makeRegularGrid({2, 2, 2}, Vec3::Zero(), Vec3::Ones()).positions;
  const std::vector<Hexahedron> one{{0, 1, 3, 2, 4, 5, 7, 6}}, turned{{4, 5, 7, 6, 0, 1, 3, 2}};
  EXPECT_EQ(ElementMesh<TrilinearHexahedron>::findFlaw(cube, one).count, 0);
  EXPECT_EQ(ElementMesh<TrilinearHexahedron>::findFlaw(cube, turned).count, 1);
  cube[7] = Vec3(0.1, 0.1, 0.1);  // a corner pushed through the middle
  EXPECT_EQ(ElementMesh<TrilinearHexahedron>::findFlaw(cube, one).count, 1);
}

}  // namespace
}  // namespace stroma::test
