// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/shared_nodes.h"

#include <algorithm>
#include <numeric>

namespace stroma {

void SharedNodes::set(std::vector<Index> nodes) {
  nodes_ = std::move(nodes);
  originCount_ = nodes_.size();
  shares_.assign(originCount_, 1);
  origins_.resize(originCount_);
  std::iota(origins_.begin(), origins_.end(), std::size_t{0});
  places_.clear();
  for (std::size_t k = 0; k < originCount_; ++k) places_.emplace(nodes_[k], k);
}

void SharedNodes::restore() {
  for (std::size_t k = originCount_; k < nodes_.size(); ++k) places_.erase(nodes_[k]);
  nodes_.resize(originCount_);
  origins_.resize(originCount_);
  shares_.assign(originCount_, 1);
}

}  // namespace stroma
