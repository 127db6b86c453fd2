// SPDX-License-Identifier: Apache-2.0
// A cube held on all sides under the body force of a chosen smooth displacement: the error, in the
// L2 norm, falls with the square of the elements' size.
#include <gtest/gtest.h>

#include <Eigen/IterativeLinearSolvers>

#include "components/material/hooke_cauchy.h"
#include "tests/components/fem/element_body.h"

namespace stroma::test {
namespace {

const Lame lame(1, 0.3);
const Vec3 amplitude(1, 0.5, -0.3);

// u = c sin(pi x) sin(pi y) sin(pi z)
Vec3 exact(const Vec3& X) {
  return amplitude * std::sin(M_PI * X.x()) * std::sin(M_PI * X.y()) * std::sin(M_PI * X.z());
}
// -((lambda + mu) grad div u + mu laplace u)
Vec3 bodyForce(const Vec3& X) {
  const Vec3 s(std::sin(M_PI * X.x()), std::sin(M_PI * X.y()), std::sin(M_PI * X.z()));
  const Vec3 c(std::cos(M_PI * X.x()), std::cos(M_PI * X.y()), std::cos(M_PI * X.z()));
  Mat3 second;  // of sin sin sin, over pi^2
  second << -s.prod(), c[0] * c[1] * s[2], c[0] * s[1] * c[2], c[0] * c[1] * s[2], -s.prod(),
      s[0] * c[1] * c[2], c[0] * s[1] * c[2], s[0] * c[1] * c[2], -s.prod();
  return -M_PI * M_PI *
         ((lame.lambda + lame.mu) * second * amplitude - 3 * lame.mu * s.prod() * amplitude);
}

// Shape functions and weights of rules good to third order, on a unit cell's worth of volume.
template <class Element>
struct Rule;
template <>
struct Rule<LinearTetrahedron> {
  static std::vector<std::pair<Eigen::Vector4d, double>> points() {
    const double b = (5 - std::sqrt(5.0)) / 20;
    std::vector<std::pair<Eigen::Vector4d, double>> rule;
    for (int q = 0; q < 4; ++q) {
      Eigen::Vector4d n = Eigen::Vector4d::Constant(b);
      n[q] = 1 - 3 * b;
      rule.emplace_back(n, 1.0 / 24);
    }
    return rule;
  }
};
template <>
struct Rule<TrilinearHexahedron> {
  static std::vector<std::pair<Eigen::Matrix<double, 8, 1>, double>> points() {
    std::vector<std::pair<Eigen::Matrix<double, 8, 1>, double>> rule;
    const double at[] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[] = {5 / 9., 8 / 9., 5 / 9.};
    for (int q = 0; q < 27; ++q) {
      const int i[] = {q % 3, q / 3 % 3, q / 9};
      Eigen::Matrix<double, 8, 1> n;
      for (int a = 0; a < 8; ++a) {
        n[a] = 1;
        for (int c = 0; c < 3; ++c) n[a] *= (1 + TrilinearHexahedron::corner(a)[c] * at[i[c]]) / 2;
      }
      rule.emplace_back(n, weight[i[0]] * weight[i[1]] * weight[i[2]] / 8);
    }
    return rule;
  }
};

template <class Element>
double errorWith(Index cells) {
  const Body<Element> body({cells, cells, cells}, 0);
  const double h = 1.0 / cells;
  ElementElasticity<Element, HookeCauchy> elasticity(HookeCauchy(1, 0.3), body.mesh);
  std::vector<bool> free(body.inside);
  elasticity.prepareTangent(body.rest, TangentKind::exact);
  const auto visit = [&](auto&& at) {
    for (Index e = 0; e < body.mesh.elementCount(); ++e)
      for (const auto& [n, weight] : Rule<Element>::points()) {
        Vec3 X = Vec3::Zero();
        for (int a = 0; a < Element::nodes; ++a) X += n[a] * h * body.rest[body.mesh.nodes(e)[a]];
        at(e, X, n, weight * h * h * h);
      }
  };
  std::vector<Vec3> load(body.rest.size(), Vec3::Zero());
  visit([&](Index e, const Vec3& X, const auto& n, double weight) {
    for (int a = 0; a < Element::nodes; ++a)
      load[body.mesh.nodes(e)[a]] += weight * n[a] * bodyForce(X);
  });
  BlockPattern pattern(body.mesh.nodeCount());
  elasticity.stiffness().addPattern(pattern, 0);
  BlockMatrix matrix(std::move(pattern));
  elasticity.stiffness().addTo(matrix, 0, h);  // cells of size h are as stiff as 1 times h
  for (Index i = 0; i < body.mesh.nodeCount(); ++i)
    if (!free[i]) {
      matrix.project(i, Mat3::Zero());
      load[i].setZero();
    }
  const Eigen::SparseMatrix<double> K = matrix.lower();
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> cg(K);
  cg.setTolerance(1e-10);
  const Eigen::VectorXd u = cg.solve(flat(ConstVec3Span(load)));
  double error = 0, size = 0;
  visit([&](Index e, const Vec3& X, const auto& n, double weight) {
    Vec3 here = Vec3::Zero();
    for (int a = 0; a < Element::nodes; ++a) here += n[a] * u.segment<3>(3 * body.mesh.nodes(e)[a]);
    error += weight * (here - exact(X)).squaredNorm();
    size += weight * exact(X).squaredNorm();
  });
  return std::sqrt(error / size);
}

template <class Element>
void expectSecondOrder(const char* name) {
  const double errors[] = {errorWith<Element>(4), errorWith<Element>(8), errorWith<Element>(16)};
  const double orders[] = {std::log2(errors[0] / errors[1]), std::log2(errors[1] / errors[2])};
  std::printf("%s: L2 errors %.4f %.4f %.4f, orders %.2f %.2f\n", name, errors[0], errors[1],
              errors[2], orders[0], orders[1]);
  EXPECT_GT(orders[1], 1.9);
  EXPECT_LT(orders[1], 2.2);
}

TEST(Convergence, tetrahedraAreOfSecondOrder) {
  expectSecondOrder<LinearTetrahedron>("tetrahedra");
}

TEST(Convergence, hexahedraAreOfSecondOrder) {
  expectSecondOrder<TrilinearHexahedron>("hexahedra");
}

}  // namespace
}  // namespace stroma::test
