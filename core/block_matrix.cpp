// SPDX-License-Identifier: Apache-2.0
#include "core/block_matrix.h"

#include <algorithm>
#include <cassert>

namespace stroma {

void BlockPattern::addClique(std::span<const Index> particles) {
  for (const Index i : particles) {
    std::vector<Index>& row = rows_[static_cast<std::size_t>(i)];
    for (const Index j : particles) {
      if (j <= i) row.push_back(j);
    }
    // rows collect many duplicates: squeeze them out before they pile up
    if (row.size() > 1024) {
      std::ranges::sort(row);
      row.erase(std::unique(row.begin(), row.end()), row.end());
    }
  }
}

BlockMatrix::BlockMatrix(BlockPattern&& pattern) {
  const std::size_t n = pattern.rows_.size();
  begin_.assign(n + 1, 0);
  below_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Index>& row = pattern.rows_[i];
    row.push_back(static_cast<Index>(i));
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const Index j : row) {
      if (j != static_cast<Index>(i)) {
        below_[static_cast<std::size_t>(j)].emplace_back(static_cast<Index>(i),
                                                         static_cast<Index>(column_.size()));
      }
      column_.push_back(j);
    }
    begin_[i + 1] = static_cast<Index>(column_.size());
    std::vector<Index>().swap(row);
  }
  values_.assign(column_.size(), Mat3::Zero());
}

void BlockMatrix::setZero() { std::ranges::fill(values_, Mat3::Zero()); }

Index BlockMatrix::find(Index row, Index column) const {
  const auto begin = column_.begin() + begin_[static_cast<std::size_t>(row)];
  const auto end = column_.begin() + begin_[static_cast<std::size_t>(row) + 1];
  const auto at = std::lower_bound(begin, end, column);
  assert(at != end && *at == column);
  return static_cast<Index>(at - column_.begin());
}

void BlockMatrix::project(Index particle, const Mat3& projector) {
  const auto p = static_cast<std::size_t>(particle);
  for (Index k = begin_[p]; k < begin_[p + 1] - 1; ++k) {
    Mat3& block = values_[static_cast<std::size_t>(k)];
    block = projector * block;
  }
  for (const auto& [row, k] : below_[p]) {
    Mat3& block = values_[static_cast<std::size_t>(k)];
    block = block * projector;
  }
  Mat3& own = values_[static_cast<std::size_t>(begin_[p + 1] - 1)];
  own = projector * own * projector + (Mat3::Identity() - projector);
}

Eigen::SparseMatrix<double> BlockMatrix::lower() const {
  const std::size_t n = below_.size();
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(3 * n),
                                     static_cast<Eigen::Index>(3 * n));
  // written straight into compressed columns: a column holds its diagonal block, then those below
  // it
  std::vector<int>::size_type entries = 0;
  for (std::size_t j = 0; j < n; ++j) entries += 6 + 9 * below_[j].size();
  matrix.resizeNonZeros(static_cast<Eigen::Index>(entries));
  int* outer = matrix.outerIndexPtr();
  int* inner = matrix.innerIndexPtr();
  double* value = matrix.valuePtr();
  int at = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const Mat3& own = values_[static_cast<std::size_t>(begin_[j + 1] - 1)];
    for (int c = 0; c < 3; ++c) {
      outer[3 * j + static_cast<std::size_t>(c)] = at;
      for (int r = c; r < 3; ++r) {
        inner[at] = static_cast<int>(3 * j) + r;
        value[at++] = own(r, c);
      }
      for (const auto& [row, k] : below_[j]) {
        const Mat3& block = values_[static_cast<std::size_t>(k)];
        for (int r = 0; r < 3; ++r) {
          inner[at] = 3 * row + r;
          value[at++] = block(r, c);
        }
      }
    }
  }
  outer[3 * n] = at;
  return matrix;
}

}  // namespace stroma
