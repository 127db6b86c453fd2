// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/stable_neo_hookean.h"
#include "components/material/volume_penalty.h"

namespace stroma {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

constexpr double youngModulus = 1000, poissonRatio = 0.3;

template <class Material>
Material makeMaterial() {
  return Material(youngModulus, poissonRatio);
}
template <>
VolumePenalty makeMaterial<VolumePenalty>() {
  return VolumePenalty(youngModulus);
}

Mat3 randomMatrix(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return Mat3::NullaryExpr([&] { return uniform(random); });
}

Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// A deformed, turned state; `squeeze` below one compresses.
Mat3 randomState(std::mt19937& random, double squeeze = 1) {
  return rotation(2, Vec3(1, 2, 3)) * (squeeze * Mat3::Identity() + randomMatrix(random, 0.25));
}

template <class Function>
Matrix9 operatorMatrix(Function&& apply) {
  Matrix9 K;
  for (int k = 0; k < 9; ++k) {
    Mat3 dF = Mat3::Zero();
    dF.data()[k] = 1;
    const Mat3 dP = apply(dF);
    K.col(k) = Eigen::Map<const Vector9>(dP.data());
  }
  return K;
}

template <class Material>
class MaterialLaw : public ::testing::Test {};
using Laws =
    ::testing::Types<HookeCauchy, HookeGreen, HookeCorotated, StableNeoHookean, VolumePenalty>;
TYPED_TEST_SUITE(MaterialLaw, Laws);

TYPED_TEST(MaterialLaw, restStateHasNoEnergyAndNoStress) {
  const auto law = makeMaterial<TypeParam>();
  EXPECT_NEAR(law.energy(Mat3::Identity()), 0, 1e-12 * youngModulus);
  EXPECT_LT(law.stress(Mat3::Identity()).norm(), 1e-12 * youngModulus);
}

TYPED_TEST(MaterialLaw, stressIsEnergyDerivative) {
  const auto law = makeMaterial<TypeParam>();
  std::mt19937 random(1);
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = randomState(random), D = randomMatrix(random, 1);
    const double h = 1e-5;
    const double difference = (8 * (law.energy(F + h * D) - law.energy(F - h * D)) -
                               (law.energy(F + 2 * h * D) - law.energy(F - 2 * h * D))) /
                              (12 * h);
    const Mat3 P = law.stress(F);
    worst = std::max(worst, std::abs(difference - P.cwiseProduct(D).sum()) / (P.norm() * D.norm()));
  }
  EXPECT_LT(worst, 1e-8);
}

TYPED_TEST(MaterialLaw, tangentIsStressDerivative) {
  const auto law = makeMaterial<TypeParam>();
  std::mt19937 random(2);
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = randomState(random), D = randomMatrix(random, 1);
    const double h = 1e-5;
    const Mat3 difference = (law.stress(F + h * D) - law.stress(F - h * D)) / (2 * h);
    const Mat3 dP = law.dStress(law.tangent(F), D);
    worst = std::max(worst, (difference - dP).norm() / dP.norm());
  }
  EXPECT_LT(worst, 1e-7);
}

// The projection must be the nearest positive operator: eigenvalues clamped, eigenvectors kept.
TYPED_TEST(MaterialLaw, filteredTangentIsPositivePart) {
  const auto law = makeMaterial<TypeParam>();
  std::mt19937 random(3);
  bool sawNegative = false;
  for (int trial = 0; trial < 40; ++trial) {
    const Mat3 F = randomState(random, trial % 2 ? 1.0 : 0.4);
    const auto exact = law.tangent(F);
    const auto filtered = law.filteredTangent(F);
    const Matrix9 K = operatorMatrix([&](const Mat3& D) { return law.dStress(exact, D); });
    const Matrix9 Kf = operatorMatrix([&](const Mat3& D) { return law.dStress(filtered, D); });
    ASSERT_LT((K - K.transpose()).norm(), 1e-9 * (K.norm() + youngModulus));
    const Eigen::SelfAdjointEigenSolver<Matrix9> eigen(K);
    sawNegative |= eigen.eigenvalues()[0] < -1e-6 * youngModulus;
    const Matrix9 expected = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                             eigen.eigenvectors().transpose();
    EXPECT_LT((Kf - expected).norm(), 1e-7 * (K.norm() + youngModulus));
  }
  EXPECT_EQ(sawNegative, !(std::is_same_v<TypeParam, HookeCauchy>));
}

TYPED_TEST(MaterialLaw, rotationCostsNothing) {
  const auto law = makeMaterial<TypeParam>();
  const double stress = law.stress(rotation(0.5, Vec3(1, 1, 0))).norm();
  if (std::is_same_v<TypeParam, HookeCauchy>)
    EXPECT_GT(stress, 0.05 * youngModulus);  // the known price of infinitesimal strain
  else
    EXPECT_LT(stress, 1e-12 * youngModulus);
}

TYPED_TEST(MaterialLaw, invertedAndDegenerateStatesStayFinite) {
  const auto law = makeMaterial<TypeParam>();
  const Vec3 d(1, 2, -1);
  std::vector<Mat3> states{Mat3::Zero(),
                           -Mat3::Identity(),
                           d * d.transpose(),
                           Vec3(1, 1, 0).asDiagonal(),
                           Vec3(1, 1, -1).asDiagonal(),
                           Vec3(1, -1, -1).asDiagonal(),
                           1e-200 * Mat3::Identity()};
  for (const Mat3& F : states) {
    EXPECT_TRUE(std::isfinite(law.energy(F))) << F;
    EXPECT_TRUE(law.stress(F).allFinite()) << F;
    EXPECT_TRUE(law.dStress(law.tangent(F), Mat3::Ones()).allFinite()) << F;
    EXPECT_TRUE(law.dStress(law.filteredTangent(F), Mat3::Ones()).allFinite()) << F;
  }
}

template <class Material>
class ElasticLaw : public ::testing::Test {};
using ElasticLaws = ::testing::Types<HookeCauchy, HookeGreen, HookeCorotated, StableNeoHookean>;
TYPED_TEST_SUITE(ElasticLaw, ElasticLaws);

// Catches a factor four in the strain and a factor two in shear.
TYPED_TEST(ElasticLaw, smallStrainEnergyIsLinearElasticity) {
  const Lame lame(youngModulus, poissonRatio);
  const TypeParam law(youngModulus, poissonRatio);
  const double e = 1e-4;
  Mat3 stretched = Mat3::Identity(), sheared = Mat3::Identity();
  stretched(0, 0) += e;
  sheared(0, 1) += e;
  const double uniaxial = law.energy(stretched) / ((lame.mu + 0.5 * lame.lambda) * e * e);
  const double shear = law.energy(sheared) / (0.5 * lame.mu * e * e);
  std::printf("energy over linear elasticity: uniaxial %.6f, shear %.6f\n", uniaxial, shear);
  EXPECT_NEAR(uniaxial, 1, 1e-3);
  EXPECT_NEAR(shear, 1, 1e-3);
}

// Stress along x at the stretch with free sides: the lateral stretch by bisection.
template <class Law>
double uniaxialStress(const Law& law, double stretch) {
  double low = 0.01, high = 4;
  for (int k = 0; k < 200; ++k) {
    const double side = 0.5 * (low + high);
    const Mat3 F = Vec3(stretch, side, side).asDiagonal();
    (law.stress(F)(1, 1) > 0 ? high : low) = side;
  }
  const Mat3 F = Vec3(stretch, low, low).asDiagonal();
  return law.stress(F)(0, 0);
}

TEST(HookeGreen, uniaxialStressHasItsLimitPoint) {
  const HookeGreen law(youngModulus, poissonRatio);
  for (const auto& [stretch, expected] :
       {std::pair{0.57735, -0.19245}, {0.7, -0.1785}, {1.5, 0.9375}, {2.0, 3.0}}) {
    const double measured = uniaxialStress(law, stretch) / youngModulus;
    std::printf("P/E at %.5f: %.5f\n", stretch, measured);
    EXPECT_NEAR(measured, expected, 1e-5);
  }
}

template <class Law>
void expectTheSameByColumns(const Law& law) {
  using Lanes = double __attribute__((vector_size(32)));
  std::mt19937 random(4);
  const Mat3 F = randomState(random), P = law.stress(F);
  const auto lanes = [&F](int k) { return Lanes{F(0, k), F(1, k), F(2, k), 0}; };
  std::array<Lanes, 3> p;
  law.stressColumns(lanes(0), lanes(1), lanes(2), p[0], p[1], p[2]);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[k][c], P(c, k), 1e-12 * P.norm());
}

TEST(WithVolumePenalty, isTheSumOfBoth) {
  const HookeCorotated law(youngModulus, poissonRatio);
  const VolumePenalty penalty(2 * youngModulus);
  const WithVolumePenalty both(law, penalty);
  std::mt19937 random(5);
  const Mat3 F = randomState(random), D = randomMatrix(random, 1);
  EXPECT_EQ(both.energy(F), law.energy(F) + penalty.energy(F));
  EXPECT_EQ(both.stress(F), law.stress(F) + penalty.stress(F));
  EXPECT_EQ(both.dStress(both.tangent(F), D),
            law.dStress(law.tangent(F), D) + penalty.dStress(penalty.tangent(F), D));
  EXPECT_EQ(
      both.dStress(both.filteredTangent(F), D),
      law.dStress(law.filteredTangent(F), D) + penalty.dStress(penalty.filteredTangent(F), D));
}

TEST(Columns, giveTheSameStress) {
  const HookeCauchy cauchy(youngModulus, poissonRatio);
  const HookeGreen green(youngModulus, poissonRatio);
  const VolumePenalty penalty(2 * youngModulus);
  expectTheSameByColumns(cauchy);
  expectTheSameByColumns(green);
  expectTheSameByColumns(WithVolumePenalty(cauchy, penalty));
  expectTheSameByColumns(WithVolumePenalty(green, penalty));
}

TEST(StableNeoHookean, classicFormHasTheTextbookUniaxialStress) {
  const double nu = 0.4999, mu = youngModulus / (2 * (1 + nu));
  const StableNeoHookean classic(youngModulus, nu, StableNeoHookean::Form::classic);
  const StableNeoHookean smith(youngModulus, nu);
  for (const auto& [stretch, expected] :
       {std::pair{0.5, -3.5}, {0.7, -1.3408}, {1.5, 1.05556}, {2.0, 1.75}, {3.0, 2.88889}}) {
    const double measured = uniaxialStress(classic, stretch) / mu;
    const double logarithmic = uniaxialStress(smith, stretch) / mu;
    const double factor = 4.0 / 3 * (1 - 1 / (stretch * stretch + 2 / stretch + 1));
    std::printf("P/mu at %.1f: %.5f, with the logarithm %.5f\n", stretch, measured, logarithmic);
    EXPECT_NEAR(measured / expected, 1, 0.005);
    EXPECT_NEAR(logarithmic / (factor * expected), 1, 0.005);
  }
}

TEST(StableNeoHookean, simpleShearHasNeoHookeanStresses) {
  const double nu = 0.4999, shear = 0.5, mu = youngModulus / (2 * (1 + nu));
  const StableNeoHookean law(youngModulus, nu, StableNeoHookean::Form::classic);
  Mat3 F = Mat3::Identity();
  F(0, 1) = shear;
  const Mat3 sigma = law.stress(F) * F.transpose();
  EXPECT_NEAR(sigma(0, 1) / (mu * shear), 1, 0.01);
  EXPECT_NEAR((sigma(0, 0) - sigma(1, 1)) / (mu * shear * shear), 1, 0.01);
}

TEST(PolarDecomposition, isTheClosestProperRotation) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    Mat3 F = randomMatrix(random, 1);
    if (trial % 3 == 0) F.col(2) = F.col(0) + 1e-9 * F.col(1);  // nearly singular
    const Mat3 R = closestRotation(F);
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-14);
    EXPECT_GT(R.determinant(), 0);
    const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double side = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const double best = svd.singularValues().dot(Vec3(1, 1, side));
    EXPECT_NEAR(R.cwiseProduct(F).sum(), best, 1e-13 * F.norm());
  }
}

TEST(PolarDecomposition, recoversLargeRotationsToRounding) {
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    const Mat3 R = rotation(angle, Vec3(1, -2, 0.5));
    Mat3 S;
    S << 1.3, 0.1, 0.2, 0.1, 0.8, -0.1, 0.2, -0.1, 1.0;
    EXPECT_LT((closestRotation(R * S) - R).norm(), 1e-14) << angle;
  }
}

TEST(LameParameters, refusesImpossibleTissue) {
  EXPECT_THROW(Lame(0, 0.3), std::invalid_argument);
  EXPECT_THROW(Lame(-5, 0.3), std::invalid_argument);
  EXPECT_THROW(Lame(1000, 0.5), std::invalid_argument);
  EXPECT_THROW(Lame(1000, -1), std::invalid_argument);
  EXPECT_THROW(Lame(1000, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace stroma
