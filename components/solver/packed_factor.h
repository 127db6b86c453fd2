// SPDX-License-Identifier: Apache-2.0
// Factors L D L^T of a symmetric matrix of 3x3 blocks, and their packed form for back-substitution.
#pragma once

#include <Eigen/SparseCholesky>

#include "core/types.h"

namespace stroma {

// AMD on the graph of the blocks: the three rows of a particle stay together, so that L consists of
// whole blocks, too.
struct BlockOrdering {
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  void operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& inverse) const;
};

using BlockFactor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, BlockOrdering>;

// A copy of a factor that back-substitution streams through: 3x3 blocks in single precision. A
// solve reads half the memory that the factor itself takes, and computes three numbers at a time.
// Good to about six digits: a preconditioner, not a solution.
class PackedFactor {
 public:
  // The factor must have been computed, with positive pivots. Throws std::invalid_argument
  // where its matrix did not consist of whole 3x3 blocks.
  explicit PackedFactor(const BlockFactor& factor);
  PackedFactor() = default;

  // z is about A^-1 r, whatever the scales of A and r; not finite where r is not.
  void solve(ConstVec3Span r, Vec3Span z);

 private:
  using Lanes = float __attribute__((vector_size(16)));
  struct Block {
    Lanes column[3];
  };
  struct Cell {
    Lanes value;
  };
  struct Diagonal {
    float l10, l20, l21;    // of the unit triangle
    float inversePivot[3];  // times the largest pivot
  };
  double largestPivot_ = 1;
  std::vector<Index> place_;  // of a particle in the factor's order
  std::vector<Diagonal> diagonal_;
  std::vector<std::size_t> begin_;  // of a block column's blocks below the diagonal
  std::vector<Index> row_;
  std::vector<Block> block_;
  std::vector<Cell> work_;
};

}  // namespace stroma
