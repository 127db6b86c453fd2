// SPDX-License-Identifier: Apache-2.0
// Elements that share no node may move their nodes at the same time. The greedy colouring gives
// each element, in its order, the first colour that none of its nodes has yet; the elements are
// then taken colour by colour, which is one fixed order whatever the number of threads.
#pragma once

#include <vector>

#include "core/parallel.h"
#include "core/types.h"

namespace stroma {

struct Colouring {
  std::vector<Index> order;  // elements, colour by colour, within a colour ascending
  std::vector<Index> begin;  // of each colour in `order`, and the end
  [[nodiscard]] Index colours() const { return static_cast<Index>(begin.size()) - 1; }
};

// Calls body(k) for every k up to begin.back(): one colour after the other, what has the same
// colour in parallel.
template <class Body>
void forEachByColour(std::span<const Index> begin, Index chunk, Body&& body) {
  for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
    const Index first = begin[c];
    parallelChunks(begin[c + 1] - first, chunk, [&](Index from, Index to) {
      for (Index k = from; k < to; ++k) body(static_cast<std::size_t>(first + k));
    });
  }
}

// `nodes` has those of all elements, `perElement` after each other.
[[nodiscard]] Colouring colourElements(std::span<const Index> nodes, std::size_t perElement,
                                       Index nodeCount);

}  // namespace stroma
