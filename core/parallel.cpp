// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace stroma {
namespace {

int threads = 1;
std::unique_ptr<tbb::global_control> limit;  // more threads than cores when asked for
std::unique_ptr<tbb::task_arena> arena;

}  // namespace

void setThreadCount(int count) {
#ifdef __SANITIZE_THREAD__
  count = 1;  // the sanitizer does not see how oneTBB, which is built without it, hands work over
#endif
  threads = std::max(1, count);
  arena.reset();
  limit.reset();
  if (threads == 1) return;
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(threads));
  arena = std::make_unique<tbb::task_arena>(threads);
}

int threadCount() { return threads; }

void detail::runChunks(Index count, Index chunk, ChunkFunction function, void* context) {
  if (count <= 0) return;
  const Index chunks = (count + chunk - 1) / chunk;
  const auto run = [&](Index c) { function(context, c * chunk, std::min(count, (c + 1) * chunk)); };
  if (!arena || chunks == 1) {
    for (Index c = 0; c < chunks; ++c) run(c);
    return;
  }
  arena->execute([&] { tbb::parallel_for(Index{0}, chunks, run); });
}

}  // namespace stroma
