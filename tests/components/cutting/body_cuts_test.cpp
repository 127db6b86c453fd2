// SPDX-License-Identifier: Apache-2.0
// The quick ones: see many_body_cuts_test.cpp.
#include "tests/components/cutting/body_cuts.h"

namespace stroma::test {
namespace {

TEST(BodyCuts, someKeepEveryLinkOfTheCorneaRight) {
  EXPECT_EQ(cutBodies(corneaToDivide(), 1, 6, {}).cuts, 6);
}

TEST(BodyCuts, someKeepEveryLinkOfTheLiverRight) {
  EXPECT_EQ(cutBodies(liverToDivide(), 101, 4, {}).cuts, 4);
}

// Its tenth cut leaves rows whose neighbours hardly fill space: the rounding of what makes them
// consistent would show in linear motions.
TEST(BodyCuts, keepLinearMotionsExactWhereRowsAreNearlyFlat) {
  EXPECT_EQ(cutBodies(corneaToDivide(), 10678, 10, {2, 400}).cuts, 10);
}

}  // namespace
}  // namespace stroma::test
