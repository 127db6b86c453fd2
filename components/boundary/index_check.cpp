// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/index_check.h"

#include <algorithm>
#include <numeric>

namespace stroma {

bool checkIndices(Component& component, const Attribute<IndexList>& indices,
                  const MechanicalState& state) {
  std::vector<Index> sorted = indices->indices;
  std::ranges::sort(sorted);
  if (!sorted.empty() && (sorted.front() < 0 || sorted.back() >= state.size())) {
    const Index bad = sorted.front() < 0 ? sorted.front() : sorted.back();
    component.error(indices, "index-range",
                    "names particle " + std::to_string(bad) + ", but '" + state.path() + "' has " +
                        std::to_string(state.size()) + " particles",
                    "particles are counted from 0 to " + std::to_string(state.size() - 1));
    return false;
  }
  const auto twice = std::ranges::adjacent_find(sorted);
  if (twice != sorted.end()) {
    component.error(indices, "index-twice", "names particle " + std::to_string(*twice) + " twice");
    return false;
  }
  // a region that found nothing has said so itself
  const auto* region =
      indices.source() ? dynamic_cast<const Component*>(&indices.source()->owner()) : nullptr;
  if (sorted.empty() && indices.isSet() && !(region && region->warned())) {
    component.warning("index-empty",
                      "acts on no particle: '" + std::string(indices.name()) + "' is empty");
  }
  return true;
}

std::vector<Index> allIndices(Index count) {
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace stroma
