// SPDX-License-Identifier: Apache-2.0
// What one explicit total-Lagrangian step costs when nothing but its arithmetic is there: the
// yardstick that the engine's own step is compared with in the same run.
#pragma once

#include <memory>

#include "core/types.h"

namespace stroma::bench {

class LimitStep {
 public:
  // A jittered lattice of nx * ny * nz particles with `neighbours` nearest neighbours each.
  LimitStep(Index nx, Index ny, Index nz, Index neighbours);
  ~LimitStep();
  void step();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace stroma::bench
