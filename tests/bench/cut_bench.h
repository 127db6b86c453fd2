// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stroma::bench {

// Registers the benchmarks of cutting.
void registerCutBenchmarks();

}  // namespace stroma::bench
