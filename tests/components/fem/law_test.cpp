// SPDX-License-Identifier: Apache-2.0
// Uniform motions of a block against formulas, and what the elements use of the material library.
#include <gtest/gtest.h>

#include "components/material/closest_rotations.h"
#include "components/material/hooke_cauchy.h"
#include "components/material/hooke_corotated.h"
#include "components/material/hooke_green.h"
#include "components/material/neo_hookean.h"
#include "components/material/stable_neo_hookean.h"
#include "tests/components/fem/element_body.h"

namespace stroma::test {
namespace {

const double youngModulus = 1000, poissonRatio = 0.3;
const Lame lame(youngModulus, poissonRatio);
const double mu = lame.mu, lambda = lame.lambda, bulk = lambda + 2 * mu / 3;

// Force along x on the face of a block of 2 x 2 x 2 that faces along `axis`, per area.
template <class Element, class Material>
double tractionOf(const Material& material, const Mat3& F, int axis) {
  Body<Element> body({2, 2, 2});
  ElementElasticity<Element, Material> elasticity(material, body.mesh);
  std::vector<Vec3> f(body.rest.size(), Vec3::Zero());
  elasticity.addForces(body.moved(F, 0), f);
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (body.grid.positions[i][axis] > 1.9) sum -= f[i].x();
  return sum / 4;
}

template <class Material>
void expectTractions(const char* name, const Material& material, double stretch, double uniaxial,
                     double shear, double sheared) {
  Mat3 S = Mat3::Identity(), G = Mat3::Identity();
  S(0, 0) = stretch;
  G(0, 1) = shear;
  const double errors[] = {std::abs(tractionOf<LinearTetrahedron>(material, S, 0) / uniaxial - 1),
                           std::abs(tractionOf<TrilinearHexahedron>(material, S, 0) / uniaxial - 1),
                           std::abs(tractionOf<LinearTetrahedron>(material, G, 1) / sheared - 1),
                           std::abs(tractionOf<TrilinearHexahedron>(material, G, 1) / sheared - 1)};
  std::printf("%s: stretched %.1e %.1e, sheared %.1e %.1e off\n", name, errors[0], errors[1],
              errors[2], errors[3]);
  for (const double error : errors) EXPECT_LT(error, 1e-12) << name;
}

TEST(UniformMotion, hasTheTractionsOfTheFormulas) {
  const double s = 1.4, g = 0.6;
  const double halfTurn = std::sqrt(4 + g * g);  // twice the norm of the turned shear's cosine part
  expectTractions("cauchy", HookeCauchy(youngModulus, poissonRatio), s, (2 * mu + lambda) * (s - 1),
                  g, mu * g);
  expectTractions("green", HookeGreen(youngModulus, poissonRatio), s,
                  s * (mu + lambda / 2) * (s * s - 1), g, mu * g + g * (mu + lambda / 2) * g * g);
  // the closest rotation of a simple shear turns by atan(g/2); tr S = sqrt(4 + g^2) + 1
  expectTractions("corotated", HookeCorotated(youngModulus, poissonRatio), s,
                  (2 * mu + lambda) * (s - 1), g,
                  2 * mu * (g - g / halfTurn) + lambda * (halfTurn - 2) * g / halfTurn);
  expectTractions("neo-Hookean", NeoHookean(youngModulus, poissonRatio), s,
                  mu * std::pow(s, -2.0 / 3) * (s - (s * s + 2) / (3 * s)) + bulk * std::log(s) / s,
                  g, mu * g);
  const double a = 1 + mu / (lambda + mu);
  expectTractions("stable neo-Hookean, classic",
                  StableNeoHookean(youngModulus, poissonRatio, StableNeoHookean::Form::classic), s,
                  mu * s + (lambda + mu) * (s - a), g, mu * g);
}

TEST(ClosestRotations, areThoseFoundOneByOne) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double worst = 0, orthogonal = 0;
  for (int batch = 0; batch < 2000; ++batch) {
    MatrixBatch F, R;
    for (Mat3& f : F) {
      for (int k = 0; k < 9; ++k) f.data()[k] = 0.5 * normal(random);
      // near rest, anything, inverted, flat
      if (batch % 3 == 0) f = rotation(normal(random), {1, 2, 3}) * (Mat3::Identity() + 0.3 * f);
      if (batch % 7 == 0) f.col(1) = f.col(0) * 0.2 + 1e-9 * f.col(1);
    }
    if (batch == 5) F[3].setZero();
    closestRotations(F, R);
    for (int k = 0; k < rotationBatch; ++k) {
      orthogonal = std::max(orthogonal, (R[k].transpose() * R[k] - Mat3::Identity()).norm());
      EXPECT_GT(R[k].determinant(), 0);
      // the nearest where it is unique: as close as the one found alone
      const double alone = (F[k] - closestRotation(F[k])).norm();
      worst = std::max(worst, ((F[k] - R[k]).norm() - alone) / (1 + alone));
    }
  }
  std::printf("rotations eight at a time: %.1e farther, %.1e from orthogonal\n", worst, orthogonal);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(orthogonal, 1e-13);
}

TEST(HookeCorotated, filteredTangentWithoutEigenvectorsIsTheSame) {
  // the filter of a law turned by hand: eigenvalues of the 9x9 operator, clamped
  const HookeCorotated law(youngModulus, poissonRatio);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int k = 0; k < 500; ++k) {
    Mat3 F;
    for (int i = 0; i < 9; ++i) F.data()[i] = 0.15 * normal(random);
    F += (k % 5 == 0 ? 1.4 : k % 5 == 1 ? 0.7 : 1.0) * Mat3::Identity();
    const auto operatorOf = [&](const auto& tangent) {
      Eigen::Matrix<double, 9, 9> C;
      for (int i = 0; i < 9; ++i) {
        Mat3 unit = Mat3::Zero();
        unit.data()[i] = 1;
        const Mat3 column = law.dStress(tangent, unit);
        C.col(i) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(column.data());
      }
      return C;
    };
    const auto exact = operatorOf(law.tangent(F)), filtered = operatorOf(law.filteredTangent(F));
    const auto eigen = symmetricEigen<9>(exact);
    const Eigen::Matrix<double, 9, 9> clamped =
        eigen.vectors * eigen.values.cwiseMax(0).asDiagonal() * eigen.vectors.transpose();
    worst = std::max(worst, (filtered - clamped).norm() / clamped.norm());
  }
  std::printf("corotated filter against clamped eigenvalues: %.1e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(NeoHookean, restsAtRestAndHasNoEnergyBeyondInversion) {
  const NeoHookean law(youngModulus, poissonRatio);
  EXPECT_NEAR(law.energy(Mat3::Identity()), 0, 1e-12);
  EXPECT_LT(law.stress(Mat3::Identity()).norm(), 1e-12);
  Mat3 inverted = Mat3::Identity();
  inverted(2, 2) = -0.1;
  EXPECT_EQ(law.energy(inverted), std::numeric_limits<double>::infinity());
  // the small-strain moduli
  Mat3 e;
  e << 1, 2, 0, 2, -1, 1, 0, 1, 3;
  const Mat3 hooke = 2 * mu * e + lambda * e.trace() * Mat3::Identity();
  EXPECT_LT((law.dStress(law.tangent(Mat3::Identity()), e) - hooke).norm(), 1e-11 * hooke.norm());
}

}  // namespace
}  // namespace stroma::test
