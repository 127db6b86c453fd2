// SPDX-License-Identifier: Apache-2.0
// Parallel loops whose results do not depend on the number of threads: the range is cut into chunks
// of a fixed size, and reductions add the chunks' partial results in order.
#pragma once

#include <algorithm>
#include <vector>

#include "core/types.h"

namespace stroma {

// Number of threads that loops may use; 1 runs every loop in the calling thread, without oneTBB.
void setThreadCount(int threads);
[[nodiscard]] int threadCount();

namespace detail {
using ChunkFunction = void (*)(void* context, Index begin, Index end);
void runChunks(Index count, Index chunk, ChunkFunction function, void* context);
}  // namespace detail

// Calls body(begin, end) on consecutive ranges of at most `chunk` items that cover [0, count).
// The body must write only what belongs to its own items.
template <class Body>
void parallelChunks(Index count, Index chunk, Body&& body) {
  detail::runChunks(
      count, chunk,
      [](void* context, Index begin, Index end) {
        (*static_cast<std::remove_reference_t<Body>*>(context))(begin, end);
      },
      &body);
}

inline constexpr Index defaultChunk = 512;

// Calls body(i) for every i in [0, count).
template <class Body>
void parallelFor(Index count, Body&& body) {
  parallelChunks(count, defaultChunk, [&body](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) body(i);
  });
}

// Sum of body(begin, end) over fixed chunks, added in order: the same bits at any thread count.
template <class T, class Body>
[[nodiscard]] T parallelSum(Index count, T zero, Body&& body) {
  constexpr Index chunk = 2048;
  if (count <= chunk) return count > 0 ? T(zero + body(Index{0}, count)) : zero;
  std::vector<T> partial(static_cast<std::size_t>((count + chunk - 1) / chunk), zero);
  parallelChunks(count, chunk, [&](Index begin, Index end) {
    partial[static_cast<std::size_t>(begin / chunk)] = body(begin, end);
  });
  T sum = zero;
  for (const T& part : partial) sum = sum + part;
  return sum;
}

}  // namespace stroma
