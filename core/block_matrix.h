// SPDX-License-Identifier: Apache-2.0
// Symmetric sparse matrix of 3x3 blocks with a fixed pattern, filled by force fields and handed to
// direct solvers.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/types.h"

namespace stroma {

// Which pairs of particles interact. Each unordered pair may be given more than once.
class BlockPattern {
 public:
  explicit BlockPattern(Index size) : rows_(static_cast<std::size_t>(size)) {}
  void add(Index row, Index column) {
    if (row < column) std::swap(row, column);
    rows_[static_cast<std::size_t>(row)].push_back(column);
  }
  // Every pair out of `particles`.
  void addClique(std::span<const Index> particles);

 private:
  friend class BlockMatrix;
  std::vector<std::vector<Index>> rows_;
};

// Stores the lower triangle (row >= column) by rows, columns ascending; the diagonal is always
// present.
class BlockMatrix {
 public:
  BlockMatrix() = default;
  explicit BlockMatrix(BlockPattern&& pattern);

  [[nodiscard]] Index size() const { return static_cast<Index>(begin_.size()) - 1; }
  void setZero();
  // Adds `block` at (row, column). Blocks above the diagonal are skipped: the caller adds both (i,
  // j) and (j, i), transposed to each other, or only the lower one.
  void add(Index row, Index column, const Mat3& block) {
    if (row < column) return;
    values_[static_cast<std::size_t>(find(row, column))] += block;
  }
  void addDiagonal(Index row, double value) {
    values_[static_cast<std::size_t>(begin_[static_cast<std::size_t>(row) + 1] - 1)]
        .diagonal()
        .array() += value;
  }
  [[nodiscard]] const Mat3& diagonal(Index row) const {
    return values_[static_cast<std::size_t>(begin_[static_cast<std::size_t>(row) + 1] - 1)];
  }
  // A <- P A P + (I - P) for the block-diagonal projector P that is `projector` at `particle`, else
  // I.
  void project(Index particle, const Mat3& projector);
  // Lower triangle with scalar entries; the pattern is the same at every call.
  [[nodiscard]] Eigen::SparseMatrix<double> lower() const;

 private:
  [[nodiscard]] Index find(Index row, Index column) const;
  std::vector<Index> begin_{0}, column_;
  std::vector<Mat3> values_;
  std::vector<std::vector<std::pair<Index, Index>>> below_;  // for each column: (row, position)
};

}  // namespace stroma
