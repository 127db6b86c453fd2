// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/colouring.h"

namespace stroma {

Colouring colourElements(std::span<const Index> nodes, std::size_t perElement, Index nodeCount) {
  const std::size_t count = nodes.size() / perElement;
  std::vector<std::vector<Index>> taken(static_cast<std::size_t>(nodeCount));
  std::vector<Index> colourOf(count);
  Colouring colouring;
  colouring.begin.push_back(0);
  for (std::size_t e = 0; e < count; ++e) {
    const auto own = nodes.subspan(e * perElement, perElement);
    const auto isFree = [&](Index colour) {
      return std::ranges::none_of(own, [&](Index i) {
        return std::ranges::count(taken[static_cast<std::size_t>(i)], colour) > 0;
      });
    };
    Index colour = 0;
    while (!isFree(colour)) ++colour;
    for (const Index i : own) taken[static_cast<std::size_t>(i)].push_back(colour);
    colourOf[e] = colour;
    const auto ends = static_cast<std::size_t>(colour) + 2;
    if (colouring.begin.size() < ends) colouring.begin.resize(ends, 0);
    ++colouring.begin[ends - 1];
  }
  for (std::size_t c = 1; c < colouring.begin.size(); ++c)
    colouring.begin[c] += colouring.begin[c - 1];
  std::vector<Index> next(colouring.begin.begin(), colouring.begin.end() - 1);
  colouring.order.resize(count);
  for (std::size_t e = 0; e < count; ++e) {
    Index& place = next[static_cast<std::size_t>(colourOf[e])];
    colouring.order[static_cast<std::size_t>(place++)] = static_cast<Index>(e);
  }
  return colouring;
}

}  // namespace stroma
