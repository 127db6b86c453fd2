// SPDX-License-Identifier: Apache-2.0
#include "components/fem/node_matrix.h"

#include <algorithm>

#include "core/parallel.h"

namespace stroma {

NodeMatrix::NodeMatrix(const std::vector<std::vector<Index>>& neighbours) : begin_{0} {
  for (const auto& row : neighbours) {
    columns_.insert(columns_.end(), row.begin(), row.end());
    begin_.push_back(static_cast<Index>(columns_.size()));
  }
  values_.assign(columns_.size(), Mat3::Zero());
}

Index NodeMatrix::place(Index row, Index column) const {
  const auto begin = columns_.begin() + begin_[row], end = columns_.begin() + begin_[row + 1];
  return static_cast<Index>(std::lower_bound(begin, end, column) - columns_.begin());
}

void NodeMatrix::clearRow(Index row) {
  std::fill(values_.begin() + begin_[row], values_.begin() + begin_[row + 1], Mat3::Zero());
}

void NodeMatrix::addProduct(double factor, ConstVec3Span x, Vec3Span y) const {
  parallelFor(size(), [&](Index i) {
    Vec3 sum = Vec3::Zero();
    for (Index k = begin_[i]; k < begin_[i + 1]; ++k) sum += values_[k] * x[columns_[k]];
    y[i] += factor * sum;
  });
}

void NodeMatrix::addPattern(BlockPattern& pattern, Index offset) const {
  for (Index i = 0; i < size(); ++i)
    for (Index k = begin_[i]; k < begin_[i + 1] && columns_[k] <= i; ++k)
      pattern.add(offset + i, offset + columns_[k]);
}

void NodeMatrix::addTo(BlockMatrix& matrix, Index offset, double factor) const {
  for (Index i = 0; i < size(); ++i)
    for (Index k = begin_[i]; k < begin_[i + 1] && columns_[k] <= i; ++k)
      matrix.add(offset + i, offset + columns_[k], factor * values_[k]);
}

}  // namespace stroma
