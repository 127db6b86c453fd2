// SPDX-License-Identifier: Apache-2.0
// A symmetric matrix of 3x3 blocks between the nodes of a mesh, kept by whole rows: every row of a
// product is gathered on its own, so that products have the same bits at any number of threads.
#pragma once

#include <vector>

#include "core/block_matrix.h"

namespace stroma {

class NodeMatrix {
 public:
  // neighbours[i]: the columns of row i, ascending, i among them unless the row is empty.
  explicit NodeMatrix(const std::vector<std::vector<Index>>& neighbours);

  [[nodiscard]] Index size() const { return static_cast<Index>(begin_.size()) - 1; }
  // Where block (row, column) is kept; both must be neighbours.
  [[nodiscard]] Index place(Index row, Index column) const;
  [[nodiscard]] Mat3& at(Index place) { return values_[place]; }
  void clearRow(Index row);

  // y += factor A x
  void addProduct(double factor, ConstVec3Span x, Vec3Span y) const;
  void addPattern(BlockPattern& pattern, Index offset) const;
  // matrix += factor A
  void addTo(BlockMatrix& matrix, Index offset, double factor) const;

 private:
  std::vector<Index> begin_, columns_;
  std::vector<Mat3> values_;
};

}  // namespace stroma
