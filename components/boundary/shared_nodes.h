// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>
#include <vector>

#include "core/topology_change.h"

namespace stroma {

// Nodes that something acts on, each with its share of what acts there. When the body is cut
// through a node, its copy joins and each of the two takes half: they are at the same place, so
// that a cut changes no total force, no total stiffness and no energy. Nodes that appear on split
// edges take nothing: the ends have it all.
class SharedNodes {
 public:
  // Distinct nodes, with all of their shares.
  void set(std::vector<Index> nodes);
  // Calls joined(k) for the k-th node whenever its copy is appended.
  template <class Joined>
  void follow(const TopologyChange& change, Joined&& joined) {
    for (std::size_t n = 0; n < change.edit.nodes.size(); ++n) {
      const auto at = places_.find(change.edit.nodes[n].copyOf);
      if (at == places_.end()) continue;
      const std::size_t k = at->second;
      places_.emplace(change.edit.firstNewNode + static_cast<Index>(n), nodes_.size());
      nodes_.push_back(change.edit.firstNewNode + static_cast<Index>(n));
      origins_.push_back(origins_[k]);
      shares_.push_back(shares_[k] *= 0.5);
      joined(k);
    }
  }
  // Back to what was set.
  void restore();

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const std::vector<Index>& nodes() const { return nodes_; }
  [[nodiscard]] std::size_t node(std::size_t k) const {
    return static_cast<std::size_t>(nodes_[k]);
  }
  [[nodiscard]] double share(std::size_t k) const { return shares_[k]; }
  // Which of the nodes that were set it came from.
  [[nodiscard]] std::size_t origin(std::size_t k) const { return origins_[k]; }
  [[nodiscard]] std::size_t originCount() const { return originCount_; }

 private:
  std::vector<Index> nodes_;
  std::vector<double> shares_;
  std::vector<std::size_t> origins_;
  std::size_t originCount_ = 0;
  std::unordered_map<Index, std::size_t> places_;
};

}  // namespace stroma
