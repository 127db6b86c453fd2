// SPDX-License-Identifier: Apache-2.0
// The elements of this module: which nodes a topology gives them, and the derivatives of their
// shape functions by the reference coordinates at the quadrature points. Node order as in Mesh.
#pragma once

#include <cmath>
#include <string_view>

#include "core/interfaces/mesh.h"

namespace stroma {

// Linear on the reference tetrahedron (0, e1, e2, e3), with one point: the strain is constant.
struct LinearTetrahedron {
  static constexpr int nodes = 4, points = 1;
  static constexpr std::string_view plural = "tetrahedra";
  static constexpr std::string_view order =
      "the first three nodes are counter-clockwise seen from the fourth: exchange two";
  static constexpr double weight = 1.0 / 6;  // volume that a point stands for
  using Gradients = Eigen::Matrix<double, 3, nodes>;

  static std::span<const Tetrahedron> of(const Mesh& mesh) { return mesh.tetrahedra(); }
  static Gradients referenceGradients(int) {
    Gradients g;
    g << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
    return g;
  }
};

// Trilinear on the cube [-1, 1]^3, with 2 x 2 x 2 Gauss points: one face in turn, then the
// opposite.
struct TrilinearHexahedron {
  static constexpr int nodes = 8, points = 8;
  static constexpr std::string_view plural = "hexahedra";
  static constexpr std::string_view order =
      "nodes go round one face, counter-clockwise seen from inside, then round the opposite one";
  static constexpr double weight = 1;
  using Gradients = Eigen::Matrix<double, 3, nodes>;

  static std::span<const Hexahedron> of(const Mesh& mesh) { return mesh.hexahedra(); }
  static Vec3 corner(int node) {
    return {(node + 1) / 2 % 2 ? 1.0 : -1.0, node / 2 % 2 ? 1.0 : -1.0, node / 4 ? 1.0 : -1.0};
  }
  static Gradients referenceGradients(int point) {
    const Vec3 at = corner(point) / std::sqrt(3.0);
    Gradients g;
    for (int a = 0; a < nodes; ++a) {
      const Vec3 c = corner(a), f = Vec3::Ones() + c.cwiseProduct(at);
      g.col(a) = Vec3(c[0] * f[1] * f[2], c[1] * f[2] * f[0], c[2] * f[0] * f[1]) / 8;
    }
    return g;
  }
};

}  // namespace stroma
