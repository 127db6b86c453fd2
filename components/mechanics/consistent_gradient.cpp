// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/consistent_gradient.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "core/parallel.h"

namespace stroma {
namespace {

using Mat4 = Eigen::Matrix4d;
using Vec4d = Eigen::Vector4d;
using Mat43 = Eigen::Matrix<double, 4, 3>;
using SparseMatrix = Eigen::SparseMatrix<double>;

// The particle's own entry may change little: that bends truest (measured against 0.01 to 3).
constexpr double selfWeight = 0.3;

class Projection {
 public:
  // rows: those that may change.
  Projection(ConstVec3Span X, const Neighbourhoods& n, const TransposedRows& transposed,
             std::span<const double> volumes, std::span<const Index> rows, double shift)
      : X_(X),
        n_(n),
        transposed_(transposed),
        V_(volumes),
        free_(X.size(), 0),
        scale_(X.size(), 1),
        inverse_(X.size()),
        change_(n.neighbours.size()),
        selfChange_(X.size()),
        shift_(shift) {
    for (const Index i : rows) free_[i] = 1;
    parallelFor(n.particleCount(), [&](Index i) {
      if (free_[i]) prepareRow(i);
    });
    findDiagonal();
  }

  // delta for the multipliers lambda, kept by slot, and what it adds to sum_i V_i D_a(i).
  void apply(ConstVec3Span lambda, Vec3Span out) {
    parallelFor(n_.particleCount(), [&](Index i) {
      if (free_[i]) correctRow(i, lambda);
    });
    parallelFor(n_.particleCount(), [&](Index a) {
      Vec3 sum = shift_ * diagonal_[a] * lambda[a];
      if (free_[a]) sum += V_[a] * selfChange_[a];
      for (const BackLink& link : transposed_.linksOf(a))
        if (free_[link.particle]) sum += V_[link.particle] * change_[link.slot];
      out[a] = sum;
    });
  }

  [[nodiscard]] std::span<const Vec3> changeOf(Index i) const {
    return {change_.data() + n_.rows[i].begin, static_cast<std::size_t>(n_.rows[i].size)};
  }

  [[nodiscard]] double precondition(Index a) const {
    return diagonal_[a] > 0 ? 1 / diagonal_[a] : 0;
  }

  // The matrix of apply(), with a diagonal shift against its null space of affine multipliers.
  [[nodiscard]] SparseMatrix assemble(double shift) const;

 private:
  // Basis 1, x, y, z about particle i, scaled to the size of its row.
  [[nodiscard]] Vec4d basis(Index i, Index a) const {
    const Vec3 y = scale_[i] * (X_[a] - X_[i]);
    return {1, y.x(), y.y(), y.z()};
  }

  void prepareRow(Index i) {
    const Row& row = n_.rows[i];
    double reach2 = 0;
    for (const Index j : n_.neighboursOf(i))
      reach2 = std::max(reach2, (X_[j] - X_[i]).squaredNorm());
    scale_[i] = 1 / std::sqrt(reach2);
    Mat4 G = Mat4::Zero();
    G(0, 0) = selfWeight;
    for (Index s = row.begin; s < row.begin + row.size; ++s) {
      const Vec4d p = basis(i, n_.neighbours[s]);
      G += p * p.transpose();
    }
    inverse_[i] = G.inverse();
  }

  void findDiagonal() {
    diagonal_.resize(X_.size());
    const auto entry = [this](Index i, double w, const Vec4d& p) {
      return V_[i] * V_[i] * w * (1 - w * p.dot(inverse_[i] * p));
    };
    parallelFor(n_.particleCount(), [&](Index a) {
      double sum = free_[a] ? entry(a, selfWeight, Vec4d(1, 0, 0, 0)) : 0;
      for (const BackLink& link : transposed_.linksOf(a))
        if (free_[link.particle]) sum += entry(link.particle, 1, basis(link.particle, a));
      diagonal_[a] = sum;
    });
  }

  void correctRow(Index i, ConstVec3Span lambda) {
    const Row& row = n_.rows[i];
    Mat43 moments = Mat43::Zero();
    moments.row(0) = selfWeight * lambda[i].transpose();
    for (Index s = row.begin; s < row.begin + row.size; ++s) {
      const Index a = n_.neighbours[s];
      moments += basis(i, a) * lambda[a].transpose();
    }
    const Mat43 mu = inverse_[i] * moments;
    selfChange_[i] = V_[i] * selfWeight * (lambda[i] - mu.row(0).transpose());
    for (Index s = row.begin; s < row.begin + row.size; ++s) {
      const Index a = n_.neighbours[s];
      change_[s] = V_[i] * (lambda[a] - mu.transpose() * basis(i, a));
    }
  }

  ConstVec3Span X_;
  const Neighbourhoods& n_;
  const TransposedRows& transposed_;
  std::span<const double> V_;
  std::vector<char> free_;     // rows that may change
  std::vector<double> scale_;  // one over the reach of a row
  std::vector<Mat4> inverse_;  // of sum w p p^T over a row
  std::vector<Vec3> change_, selfChange_;
  std::vector<double> diagonal_;
  double shift_;
};

SparseMatrix Projection::assemble(double shift) const {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<std::pair<Index, double>> row;
  std::vector<Vec4d> p;
  for (Index i = 0; i < n_.particleCount(); ++i) {
    if (!free_[i]) continue;
    row.assign(1, {i, selfWeight});
    p.assign(1, Vec4d(1, 0, 0, 0));
    for (Index s = n_.rows[i].begin; s < n_.rows[i].begin + n_.rows[i].size; ++s) {
      row.emplace_back(n_.neighbours[s], 1);
      p.push_back(basis(i, n_.neighbours[s]));
    }
    for (std::size_t a = 0; a < row.size(); ++a)
      for (std::size_t b = 0; b < row.size(); ++b) {
        const double coupling = row[a].second * row[b].second * p[a].dot(inverse_[i] * p[b]);
        entries.emplace_back(row[a].first, row[b].first,
                             V_[i] * V_[i] * ((a == b ? row[a].second : 0) - coupling));
      }
  }
  for (Index a = 0; a < n_.particleCount(); ++a) entries.emplace_back(a, a, shift);
  SparseMatrix S(n_.particleCount(), n_.particleCount());
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

// b_a - sum_i V_i D_a(i) with the gradients as they are.
Vec3 residualOf(Index a, const Neighbourhoods& n, const TransposedRows& transposed,
                std::span<const double> V, ConstVec3Span boundary, const Gradients& g) {
  Vec3 r = boundary[a];
  for (Index s = n.rows[a].begin; s < n.rows[a].begin + n.rows[a].size; ++s)
    r += V[a] * g.values[s];  // the row's own entry is minus the sum of the others
  for (const BackLink& link : transposed.linksOf(a)) r -= V[link.particle] * g.values[link.slot];
  return r;
}

Vec3 dot(ConstVec3Span a, ConstVec3Span b) {
  return parallelSum(static_cast<Index>(a.size()), Vec3(Vec3::Zero()), [&](Index begin, Index end) {
    Vec3 sum = Vec3::Zero();
    for (Index i = begin; i < end; ++i) sum += a[i].cwiseProduct(b[i]);
    return sum;
  });
}

Vec3 ratio(const Vec3& a, const Vec3& b) {
  return {b[0] > 0 ? a[0] / b[0] : 0, b[1] > 0 ? a[1] / b[1] : 0, b[2] > 0 ? a[2] / b[2] : 0};
}

// Conjugate gradients from zero, the three components side by side.
std::vector<Vec3> iterate(Projection& S, std::vector<Vec3> r, int iterations) {
  const auto count = static_cast<Index>(r.size());
  std::vector<Vec3> lambda(r.size(), Vec3::Zero()), z(r.size()), p(r.size(), Vec3::Zero()), Sp(r);
  Vec3 before = Vec3::Zero();
  for (int k = 0; k < iterations; ++k) {
    parallelFor(count, [&](Index a) { z[a] = S.precondition(a) * r[a]; });
    const Vec3 now = dot(r, z), beta = ratio(now, before);
    parallelFor(count, [&](Index a) { p[a] = z[a] + beta.cwiseProduct(p[a]); });
    S.apply(p, Sp);
    const Vec3 alpha = ratio(now, dot(p, Sp));
    parallelFor(count, [&](Index a) {
      lambda[a] += alpha.cwiseProduct(p[a]);
      r[a] -= alpha.cwiseProduct(Sp[a]);
    });
    before = now;
  }
  return lambda;
}

// Cholesky of the shifted matrix, refined until the shift leaves no trace.
std::vector<Vec3> factorise(Projection& S, const std::vector<Vec3>& r) {
  SparseMatrix matrix = S.assemble(0);
  const double shift = 1e-10 * Eigen::VectorXd(matrix.diagonal()).maxCoeff();
  const Eigen::SimplicialLDLT<SparseMatrix> factor(S.assemble(shift));
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("the matrix of the consistent gradient cannot be factorised");
  const auto count = static_cast<Eigen::Index>(r.size());
  Eigen::MatrixXd b(count, 3), lambda = Eigen::MatrixXd::Zero(count, 3);
  for (Eigen::Index a = 0; a < count; ++a) b.row(a) = r[a].transpose();
  Eigen::MatrixXd rest = b;
  constexpr int refinements = 8;
  for (int k = 0; k < refinements && rest.norm() > 1e-14 * b.norm(); ++k) {
    lambda += factor.solve(rest);
    rest = b - matrix * lambda;
  }
  std::vector<Vec3> out(r.size());
  for (Eigen::Index a = 0; a < count; ++a) out[a] = lambda.row(a).transpose();
  return out;
}

double norm(ConstVec3Span a) { return std::sqrt(dot(a, a).sum()); }

std::vector<Vec3> solve(Projection& S, std::vector<Vec3> r, const ProjectionOptions& options) {
  return options.exact ? factorise(S, r) : iterate(S, std::move(r), options.iterations);
}

void addChange(const Projection& S, Index local, const Row& row, std::vector<Vec3>& gradients) {
  Index slot = row.begin;
  for (const Vec3& change : S.changeOf(local)) gradients[slot++] += change;
}

// Changes keep linear motions exact but for rounding, which a row whose neighbours hardly fill
// space makes large: it is taken out where it shows.
void keepExact(ConstVec3Span X, const Neighbourhoods& n, Index i, std::vector<Vec3>& gradients) {
  constexpr double rounding = 1e-10;
  const Row& row = n.rows[i];
  Mat3 linear = Mat3::Zero();
  for (Index slot = row.begin; slot < row.begin + row.size; ++slot) {
    linear += (X[n.neighbours[slot]] - X[i]) * gradients[slot].transpose();
  }
  const double error = (linear - Mat3::Identity()).norm();
  if (!(error > rounding && error < 0.5)) return;
  const Mat3 back = linear.transpose().inverse();
  for (Index slot = row.begin; slot < row.begin + row.size; ++slot) {
    gradients[slot] = back * gradients[slot];
  }
}

// A slice or chip whose particles do not fill it asks of its few neighbours what they cannot give:
// rows that would grow out of all proportion are better left alone.
bool isModest(const Projection& S, Index local, const Row& row, std::span<const Vec3> gradients) {
  constexpr double most = 2;
  double change = 0, size = 0;
  for (const Vec3& c : S.changeOf(local)) change += c.squaredNorm();
  for (Index slot = row.begin; slot < row.begin + row.size; ++slot)
    size += gradients[slot].squaredNorm();
  return change <= most * most * size;
}

void requireSameSizes(ConstVec3Span X, const Neighbourhoods& n, const TransposedRows& transposed,
                      std::span<const double> V, ConstVec3Span boundary, const Gradients& g) {
  if (n.rows.size() != X.size() || transposed.rows.size() != X.size() || V.size() != X.size() ||
      boundary.size() != X.size() || g.values.size() != n.neighbours.size())
    throw std::invalid_argument("the parts of a consistent gradient differ in size");
}

// Some rows and the particles that they bear on, as a body of its own with compact ids.
struct Patch {
  std::vector<Index> particles;  // ascending; position: local id
  std::vector<Index> rows;       // local ids
  std::vector<Vec3> X;
  std::vector<double> V;
  Neighbourhoods n;  // the others' rows are empty
  TransposedRows transposed;
};

Patch patchOf(ConstVec3Span X, const Neighbourhoods& n, std::span<const double> V,
              std::span<const Index> rows) {
  Patch patch;
  patch.particles.assign(rows.begin(), rows.end());
  for (const Index i : rows)
    patch.particles.insert(patch.particles.end(), n.neighboursOf(i).begin(),
                           n.neighboursOf(i).end());
  std::ranges::sort(patch.particles);
  patch.particles.erase(std::unique(patch.particles.begin(), patch.particles.end()),
                        patch.particles.end());
  const auto localOf = [&](Index i) {
    return static_cast<Index>(std::ranges::lower_bound(patch.particles, i) -
                              patch.particles.begin());
  };
  for (const Index i : patch.particles) {
    patch.X.push_back(X[i]);
    patch.V.push_back(V[i]);
  }
  for (const Index i : rows) patch.rows.push_back(localOf(i));
  std::ranges::sort(patch.rows);
  patch.n.rows.resize(patch.X.size());
  for (const Index local : patch.rows) {
    const auto neighbours = n.neighboursOf(patch.particles[local]);
    const auto size = static_cast<Index>(neighbours.size());
    patch.n.rows[local] = {static_cast<Index>(patch.n.neighbours.size()), size, size};
    for (const Index j : neighbours) patch.n.neighbours.push_back(localOf(j));
  }
  patch.transposed = transpose(patch.n);
  return patch;
}

}  // namespace

ProjectionReport makeConsistent(ConstVec3Span X, const Neighbourhoods& n,
                                const TransposedRows& transposed, std::span<const double> V,
                                ConstVec3Span boundary, Gradients& g,
                                const ProjectionOptions& options) {
  requireSameSizes(X, n, transposed, V, boundary, g);
  ProjectionReport report;
  double volume = 0, enclosed = 0;
  for (std::size_t i = 0; i < X.size(); ++i) volume += V[i], enclosed += boundary[i].dot(X[i]) / 3;
  report.volumeMismatch = std::abs(volume - enclosed) / std::max(std::abs(enclosed), 1e-300);

  std::vector<Vec3> r(X.size());
  const auto findResidual = [&] {
    parallelFor(n.particleCount(),
                [&](Index a) { r[a] = residualOf(a, n, transposed, V, boundary, g); });
    return norm(r) / std::max(norm(boundary), 1e-300);
  };
  report.residualBefore = findResidual();
  std::vector<Index> rows;
  for (Index i = 0; i < n.particleCount(); ++i)
    if (g.rank[i] == 3) rows.push_back(i);
  Projection S(X, n, transposed, V, rows, 0);
  S.apply(solve(S, r, options), r);
  parallelFor(static_cast<Index>(rows.size()), [&](Index k) {
    addChange(S, rows[k], n.rows[rows[k]], g.values);
    keepExact(X, n, rows[k], g.values);
  });
  report.residualAfter = findResidual();
  return report;
}

ProjectionReport makeConsistentLocally(ConstVec3Span X, const Neighbourhoods& n,
                                       const TransposedRows& transposed, std::span<const double> V,
                                       ConstVec3Span boundary, std::span<const Index> rows,
                                       Gradients& g, const ProjectionOptions& options) {
  requireSameSizes(X, n, transposed, V, boundary, g);
  std::vector<Index> whole;
  std::ranges::copy_if(rows, std::back_inserter(whole), [&](Index i) { return g.rank[i] == 3; });
  const Patch patch = patchOf(X, n, V, whole);

  std::vector<Vec3> r(patch.particles.size());
  double size = 0;  // of the particles' own areas
  for (const double v : patch.V) size += std::pow(v, 4.0 / 3);
  const auto findResidual = [&] {
    parallelFor(static_cast<Index>(r.size()), [&](Index a) {
      r[a] = residualOf(patch.particles[a], n, transposed, V, boundary, g);
    });
    return norm(r) / std::max(std::sqrt(size), 1e-300);
  };
  ProjectionReport report;
  report.residualBefore = findResidual();
  // few free rows cannot meet every constraint: the shift turns them into least squares
  const bool all = rows.size() == X.size();
  const double shift = all ? 0 : 1e-3;
  Projection S(patch.X, patch.n, patch.transposed, patch.V, patch.rows, shift);
  S.apply(solve(S, r, options), r);
  for (const Index local : patch.rows) {
    const Index own = patch.particles[local];
    const Row& row = n.rows[own];
    if (all || isModest(S, local, row, g.values)) {
      addChange(S, local, row, g.values);
      keepExact(X, n, own, g.values);
    } else {
      ++report.left;
    }
  }
  report.residualAfter = findResidual();
  return report;
}

}  // namespace stroma
