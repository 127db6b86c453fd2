// SPDX-License-Identifier: Apache-2.0
#include "core/topology_change.h"

#include <algorithm>

namespace stroma {

void TopologyChange::follow(std::vector<Index>& list) const {
  const auto isMember = [&](Index node) { return std::ranges::find(list, node) != list.end(); };
  for (std::size_t k = 0; k < edit.nodes.size(); ++k) {
    const NewSurfaceNode& node = edit.nodes[k];
    const bool joins = node.copyOf >= 0 ? isMember(node.copyOf)
                                        : node.parents[0] >= 0 && isMember(node.parents[0]) &&
                                              isMember(node.parents[1]);
    if (joins) list.push_back(edit.firstNewNode + static_cast<Index>(k));
  }
}

}  // namespace stroma
