// SPDX-License-Identifier: Apache-2.0
#include "tests/components/cutting/random_cuts.h"

namespace stroma::test {
namespace {

TEST(ManyCuts, aThousandKeepEveryInvariant) { checkRandomCuts(1001, 1000); }

}  // namespace
}  // namespace stroma::test
