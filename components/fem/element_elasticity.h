// SPDX-License-Identifier: Apache-2.0
// Hyperelastic finite elements, total-Lagrangian: the energy sum_q w_q psi(F_q) of any law of
// components/material, its exact negative gradient as force, f_a = -sum_q w_q P_q g_qa, products
// with the stiffness, and its blocks (Bonet, Wood 2008). Momentum is kept to rounding for every
// law, angular momentum for every law that is blind to rotation.
//
// Two passes: every element leaves what it contributes to each of its nodes, then every node
// gathers in a fixed order, so that results have the same bits at any number of threads. Quadrature
// points are taken eight at a time. Nothing is allocated after construction except by
// prepareTangent. Units: SI.
#pragma once

#include "components/fem/element_mesh.h"
#include "components/fem/node_matrix.h"
#include "components/material/closest_rotations.h"
#include "components/material/elastic_law.h"
#include "core/parallel.h"

namespace stroma {

// Cauchy stress (Pa) and volume ratio of a node: means over its elements, by volume. A point that
// has collapsed has no stress.
struct NodeStress {
  Mat3 stress = Mat3::Zero();
  double volumeRatio = 1;
};

template <class Element, class Material>
class ElementElasticity {
 public:
  using Mesh = ElementMesh<Element>;

  // The mesh must outlive this object.
  ElementElasticity(const Material& material, const Mesh& mesh);

  [[nodiscard]] const Material& material() const { return material_; }

  [[nodiscard]] double energy(ConstVec3Span x) const {
    return parallelSum(mesh_.elementCount(), 0.0, [&](Index begin, Index end) {
      double sum = 0;
      for (Index e = begin; e < end; ++e)
        for (int q = 0; q < Element::points; ++q)
          sum += mesh_.point(e, q).weight * material_.energy(gradientAt(e, q, x));
      return sum;
    });
  }

  // f += forces at positions x.
  void addForces(ConstVec3Span x, Vec3Span f) {
    parallelChunks(batches_, chunk, [&](Index begin, Index end) {
      MatrixBatch P;
      for (Index b = begin; b < end; ++b) {
        stresses(gradientsOf(b, x), P);
        for (int e = 0; e < elementsOf(b); ++e)
          leave(b * batchElements + e, P.data() + e * Element::points);
      }
    });
    gather(f);
  }

  // Computes the stiffness at x for the products and blocks that follow.
  void prepareTangent(ConstVec3Span x, TangentKind kind);

  // df += factor K dx, K = d2 energy / dx2 at the prepared state (so that d force = -K dx).
  void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) const {
    stiffness_.addProduct(factor, dx, df);
  }
  [[nodiscard]] const NodeMatrix& stiffness() const { return stiffness_; }

  [[nodiscard]] NodeStress stressAt(ConstVec3Span x, Index node) const;

  [[nodiscard]] Mat3 gradientAt(Index e, int q, ConstVec3Span x) const {
    const auto& nodes = mesh_.nodes(e);
    Mat3 F = Mat3::Zero();
    for (int a = 1; a < Element::nodes; ++a)
      F += (x[nodes[a]] - x[nodes[0]]) * mesh_.point(e, q).gradients[a - 1].transpose();
    return F;
  }

 private:
  using Vec4 = double __attribute__((vector_size(32)));  // the fourth lane carries nothing
  struct alignas(32) Contribution {
    Vec4 value;
  };
  static constexpr int batchElements = rotationBatch / Element::points;
  static constexpr Index chunk = 32;  // batches

  // Whether the law can be told the closest rotation.
  static constexpr bool usesRotation = requires(const Material& m, const Mat3& F) {
    m.stress(F, F);
  };

  struct alignas(32) Columns {
    Vec4 c[3];
  };
  static Mat3 unpack(const Columns& A) {
    Mat3 out;
    for (int k = 0; k < 3; ++k) out.col(k) = Vec3(A.c[k][0], A.c[k][1], A.c[k][2]);
    return out;
  }
  static Vec4 pack(const Vec3& v) { return Vec4{v.x(), v.y(), v.z(), 0}; }

  void stresses(const MatrixBatch& F, MatrixBatch& P) const {
    if constexpr (usesRotation) {
      MatrixBatch R;
      closestRotations(F, R);
      for (int k = 0; k < rotationBatch; ++k) P[k] = material_.stress(F[k], R[k]);
    } else {
      for (int k = 0; k < rotationBatch; ++k) P[k] = material_.stress(F[k]);
    }
  }

  // Gradients of the field u at all points of an element.
  [[gnu::always_inline]] void gradients(Index e, ConstVec3Span u, Mat3* out) const {
    const auto& nodes = mesh_.nodes(e);
    const Vec4 origin = pack(u[nodes[0]]);
    Vec4 d[Element::nodes - 1];
    for (int a = 1; a < Element::nodes; ++a) d[a - 1] = pack(u[nodes[a]]) - origin;
    for (int q = 0; q < Element::points; ++q) {
      const auto& point = mesh_.point(e, q);
      Vec4 c0{}, c1{}, c2{};
      for (int a = 0; a < Element::nodes - 1; ++a) {
        const Vec3& g = point.gradients[a];
        c0 += d[a] * g[0];
        c1 += d[a] * g[1];
        c2 += d[a] * g[2];
      }
      out[q] << c0[0], c1[0], c2[0], c0[1], c1[1], c2[1], c0[2], c1[2], c2[2];
    }
  }

  // What stresses at the points of an element contribute to its nodes: sum_q w_q P_q g_qa.
  [[gnu::always_inline]] void leave(Index e, const Mat3* P) {
    Contribution* out = contributions_.data() + e * Element::nodes;
    Vec4 sums[Element::nodes - 1] = {}, origin{};
    for (int q = 0; q < Element::points; ++q) {
      const auto& point = mesh_.point(e, q);
      const Vec4 p0 = pack(P[q].col(0)) * point.weight, p1 = pack(P[q].col(1)) * point.weight,
                 p2 = pack(P[q].col(2)) * point.weight;
      for (int a = 0; a < Element::nodes - 1; ++a) {
        const Vec3& g = point.gradients[a];
        sums[a] += p0 * g[0] + p1 * g[1] + p2 * g[2];
      }
    }
    for (int a = 0; a < Element::nodes - 1; ++a) {
      out[a + 1].value = sums[a];
      origin -= sums[a];
    }
    out[0].value = origin;
  }

  // The gradients at the points of a batch; those past the end of the mesh are the identity.
  [[nodiscard]] MatrixBatch gradientsOf(Index batch, ConstVec3Span x) const {
    MatrixBatch F;
    const int elements = elementsOf(batch);
    if (elements < batchElements) F.fill(Mat3::Identity());
    for (int e = 0; e < elements; ++e)
      gradients(batch * batchElements + e, x, F.data() + e * Element::points);
    return F;
  }
  [[nodiscard]] int elementsOf(Index batch) const {
    return std::min(batchElements, mesh_.elementCount() - batch * batchElements);
  }

  void gather(Vec3Span f) const {
    parallelFor(mesh_.nodeCount(), [&](Index i) {
      Vec4 sum{};
      for (const Index place : mesh_.placesOf(i)) sum += contributions_[place].value;
      f[i] -= Vec3(sum[0], sum[1], sum[2]);
    });
  }

  // Blocks of an element's stiffness: those on and above its diagonal.
  static constexpr int blocksPerElement = Element::nodes * (Element::nodes + 1) / 2;
  static constexpr int blockAt(int row, int column) {
    return row * Element::nodes - row * (row - 1) / 2 + column - row;
  }
  template <class Tangent>
  void addBlocks(Index e, int q, const Tangent& tangent);
  void gatherBlocks();

  Material material_;
  const Mesh& mesh_;
  Index batches_;
  std::vector<Contribution> contributions_;
  NodeMatrix stiffness_;
  std::vector<std::array<Index, Element::nodes>> rows_;  // in it, of every place in the mesh
  std::vector<Columns> blocks_;
};

template <class Element, class Material>
ElementElasticity<Element, Material>::ElementElasticity(const Material& material, const Mesh& mesh)
    : material_(material),
      mesh_(mesh),
      batches_((mesh.elementCount() + batchElements - 1) / batchElements),
      contributions_(static_cast<std::size_t>(mesh.elementCount()) * Element::nodes),
      stiffness_(mesh.neighbours()) {
  for (Index e = 0; e < mesh.elementCount(); ++e)
    for (const Index row : mesh.nodes(e)) {
      auto& places = rows_.emplace_back();
      for (int b = 0; b < Element::nodes; ++b) places[b] = stiffness_.place(row, mesh.nodes(e)[b]);
    }
}

template <class Element, class Material>
void ElementElasticity<Element, Material>::prepareTangent(ConstVec3Span x, TangentKind kind) {
  blocks_.resize(static_cast<std::size_t>(mesh_.elementCount()) * blocksPerElement);
  const auto add = [&](Index batch, int k, const Mat3& F, const auto&... rotation) {
    const Index e = batch * batchElements + k / Element::points;
    const int q = k % Element::points;
    if (kind == TangentKind::filtered)
      addBlocks(e, q, material_.filteredTangent(F, rotation...));
    else
      addBlocks(e, q, material_.tangent(F, rotation...));
  };
  parallelChunks(batches_, chunk, [&](Index begin, Index end) {
    for (Index b = begin; b < end; ++b) {
      const MatrixBatch F = gradientsOf(b, x);
      const int count = elementsOf(b) * Element::points;
      std::fill_n(blocks_.begin() + b * batchElements * blocksPerElement,
                  elementsOf(b) * blocksPerElement, Columns{});
      if constexpr (usesRotation) {
        MatrixBatch R;
        closestRotations(F, R);
        for (int k = 0; k < count; ++k) add(b, k, F[k], R[k]);
      } else {
        for (int k = 0; k < count; ++k) add(b, k, F[k]);
      }
    }
  });
  gatherBlocks();
}

template <class Element, class Material>
template <class Tangent>
void ElementElasticity<Element, Material>::addBlocks(Index e, int q, const Tangent& tangent) {
  const auto& point = mesh_.point(e, q);
  Columns* blocks = blocks_.data() + e * blocksPerElement;
  std::array<Vec3, Element::nodes> g;
  g[0].setZero();
  for (int a = 1; a < Element::nodes; ++a) {
    g[a] = point.gradients[a - 1];
    g[0] -= g[a];
  }
  for (int c = 0; c < 3; ++c) {
    Columns stress[3];  // of a unit gradient of the component c along each direction
    for (int k = 0; k < 3; ++k) {
      Mat3 dF = Mat3::Zero();
      dF(c, k) = point.weight;
      const Mat3 P = material_.dStress(tangent, dF);
      stress[k] = {{pack(P.col(0)), pack(P.col(1)), pack(P.col(2))}};
    }
    for (int b = 0; b < Element::nodes; ++b) {
      Vec4 response[3];
      for (int j = 0; j < 3; ++j)
        response[j] =
            stress[0].c[j] * g[b][0] + stress[1].c[j] * g[b][1] + stress[2].c[j] * g[b][2];
      for (int a = 0; a <= b; ++a)
        blocks[blockAt(a, b)].c[c] +=
            response[0] * g[a][0] + response[1] * g[a][1] + response[2] * g[a][2];
    }
  }
}

template <class Element, class Material>
void ElementElasticity<Element, Material>::gatherBlocks() {
  parallelFor(mesh_.nodeCount(), [&](Index i) {
    stiffness_.clearRow(i);
    for (const Index place : mesh_.placesOf(i)) {
      const int a = place % Element::nodes;
      const Columns* blocks = blocks_.data() + place / Element::nodes * blocksPerElement;
      for (int b = 0; b < Element::nodes; ++b) {
        Mat3& sum = stiffness_.at(rows_[place][b]);
        if (a <= b)
          sum += unpack(blocks[blockAt(a, b)]);
        else
          sum += unpack(blocks[blockAt(b, a)]).transpose();
      }
    }
  });
}

template <class Element, class Material>
NodeStress ElementElasticity<Element, Material>::stressAt(ConstVec3Span x, Index node) const {
  NodeStress mean;
  double volume = 0, now = 0;
  for (const Index place : mesh_.placesOf(node)) {
    const Index e = place / Element::nodes;
    for (int q = 0; q < Element::points; ++q) {
      const double weight = mesh_.point(e, q).weight;
      const Mat3 F = gradientAt(e, q, x);
      const double J = F.determinant();
      volume += weight;
      now += weight * J;
      if (std::abs(J) > 1e-12) mean.stress += weight / J * material_.stress(F) * F.transpose();
    }
  }
  if (volume > 0) {
    mean.stress /= volume;
    mean.volumeRatio = now / volume;
  }
  return mean;
}

}  // namespace stroma
