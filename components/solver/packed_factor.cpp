// SPDX-License-Identifier: Apache-2.0
#include "components/solver/packed_factor.h"

#include <Eigen/OrderingMethods>
#include <cmath>
#include <stdexcept>

namespace stroma {

void BlockOrdering::operator()(const Eigen::SparseMatrix<double>& matrix,
                               PermutationType& inverse) const {
  using Sparse = Eigen::SparseMatrix<double>;
  const Eigen::Index blocks = matrix.cols() / 3;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < blocks; ++j) {
    for (Sparse::InnerIterator entry(matrix, 3 * j); entry; ++entry) {
      if (entry.row() % 3 == 0) entries.emplace_back(entry.row() / 3, j, 1.0);
    }
  }
  Sparse graph(blocks, blocks);
  graph.setFromTriplets(entries.begin(), entries.end());
  PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);
  inverse.resize(matrix.cols());
  for (Eigen::Index i = 0; i < blocks; ++i) {
    for (int c = 0; c < 3; ++c) {
      inverse.indices()[3 * i + c] = 3 * order.indices()[i] + c;
    }
  }
}

PackedFactor::PackedFactor(const BlockFactor& factor) {
  const Eigen::SparseMatrix<double>& L = factor.matrixL().nestedExpression();
  largestPivot_ = factor.vectorD().maxCoeff();
  const Eigen::VectorXd inverse = largestPivot_ * factor.vectorD().cwiseInverse();
  const auto& place = factor.permutationP().indices();
  const Eigen::Index blocks = L.cols() / 3;
  const auto count = static_cast<std::size_t>(blocks);
  place_.resize(count);
  diagonal_.resize(count);
  work_.resize(count);
  begin_.assign(1, 0);
  row_.reserve(static_cast<std::size_t>(L.nonZeros() / 9));
  block_.reserve(row_.capacity());

  const double* values = L.valuePtr();
  const int* rows = L.innerIndexPtr();
  const auto single = [](double value) { return static_cast<float>(value); };
  for (Eigen::Index j = 0; j < blocks; ++j) {
    const auto k = static_cast<std::size_t>(j);
    place_[k] = static_cast<Index>(place[3 * j] / 3);
    // below their unit diagonal the columns have 2, 1 and no entries of the triangle, then whole
    // blocks
    const int* start = L.outerIndexPtr() + 3 * j;
    const std::array<int, 3> first{start[0] + 2, start[1] + 1, start[2]};
    const int below = start[3] - start[2];
    if (start[1] - first[0] != below || start[2] - first[1] != below || below % 3 != 0) {
      throw std::invalid_argument("the factor does not consist of 3x3 blocks");
    }
    diagonal_[k] = {
        single(values[start[0]]),
        single(values[start[0] + 1]),
        single(values[start[1]]),
        {single(inverse[3 * j]), single(inverse[3 * j + 1]), single(inverse[3 * j + 2])}};
    for (int at = 0; at < below; at += 3) {
      row_.push_back(rows[first[0] + at] / 3);
      Block block;
      for (std::size_t c = 0; c < 3; ++c) {
        const double* value = values + first[c] + at;
        block.column[c] = Lanes{single(value[0]), single(value[1]), single(value[2]), 0};
      }
      block_.push_back(block);
    }
    begin_.push_back(block_.size());
  }
}

void PackedFactor::solve(ConstVec3Span r, Vec3Span z) {
  if (r.empty()) return;
  // what is not finite makes the scale or the quotients so, and is seen in z
  const double scale = flat(r).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (scale == 0) {
    std::ranges::fill(z, Vec3::Zero());
    return;
  }
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const Vec3 a = r[i] / scale;
    work_[static_cast<std::size_t>(place_[i])].value =
        Lanes{static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(a.z()), 0};
  }
  const std::size_t count = place_.size();
  for (std::size_t j = 0; j < count; ++j) {
    const Diagonal& d = diagonal_[j];
    Lanes& own = work_[j].value;
    const float y0 = own[0];
    const float y1 = own[1] - d.l10 * y0;
    const float y2 = own[2] - d.l20 * y0 - d.l21 * y1;
    own = Lanes{y0, y1, y2, 0};
    for (std::size_t k = begin_[j]; k < begin_[j + 1]; ++k) {
      const Block& b = block_[k];
      work_[static_cast<std::size_t>(row_[k])].value -=
          b.column[0] * y0 + b.column[1] * y1 + b.column[2] * y2;
    }
  }
  const auto sum = [](const Lanes& a) { return a[0] + a[1] + a[2]; };
  for (std::size_t j = count; j-- > 0;) {
    Lanes a0{}, a1{}, a2{};
    for (std::size_t k = begin_[j]; k < begin_[j + 1]; ++k) {
      const Lanes& x = work_[static_cast<std::size_t>(row_[k])].value;
      a0 += block_[k].column[0] * x;
      a1 += block_[k].column[1] * x;
      a2 += block_[k].column[2] * x;
    }
    const Diagonal& d = diagonal_[j];
    Lanes& own = work_[j].value;
    const float x2 = own[2] * d.inversePivot[2] - sum(a2);
    const float x1 = own[1] * d.inversePivot[1] - sum(a1) - d.l21 * x2;
    const float x0 = own[0] * d.inversePivot[0] - sum(a0) - d.l10 * x1 - d.l20 * x2;
    own = Lanes{x0, x1, x2, 0};
  }
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const Lanes& x = work_[static_cast<std::size_t>(place_[i])].value;
    z[i] = (scale / largestPivot_) * Vec3(x[0], x[1], x[2]);
  }
}

}  // namespace stroma
