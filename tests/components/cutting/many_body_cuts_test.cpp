// SPDX-License-Identifier: Apache-2.0
// A thousand random cuts through two whole bodies.
#include "tests/components/cutting/body_cuts.h"

namespace stroma::test {
namespace {

// What a check would find stays to be found at the end of the cut.
TEST(ManyBodyCuts, keepEveryLinkOfTheCorneaRight) {
  EXPECT_EQ(cutBodies(corneaToDivide(), 10001, 700, {2, 5}).cuts, 700);
}

TEST(ManyBodyCuts, keepEveryLinkOfTheLiverRight) {
  EXPECT_EQ(cutBodies(liverToDivide(), 20001, 300, {3, 5}).cuts, 300);
}

}  // namespace
}  // namespace stroma::test
