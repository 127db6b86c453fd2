// SPDX-License-Identifier: Apache-2.0
#include "core/path.h"

#include <gtest/gtest.h>

#include "test_components.h"

namespace stroma::test {
namespace {

class PathTest : public testing::Test {
 protected:
  PathTest() {
    EXPECT_TRUE(scene->loadText(R"(<Node name="root"><Counter name="top"/>
      <Node name="a"><Counter name="x"/><Counter name="y"/><Node name="b"><Counter name="z"/></Node></Node>
      <Node name="c"><Counter name="x"/></Node></Node>)",
                                "s.xml"))
        << scene->diagnostics().text();
    a = scene->root().children()[0].get();
    b = a->children()[0].get();
  }
  std::string find(Node& from, std::string_view path, const Component* self = nullptr) {
    std::string problem, hint;
    const PathTarget target = resolvePath(from, self, path, problem, hint);
    if (!target) return "? " + problem + " | " + hint;
    return target.component ? target.component->path() : target.node->path();
  }
  std::unique_ptr<Scene> scene = makeScene();
  Node* a = nullptr;
  Node* b = nullptr;
};

TEST_F(PathTest, firstStepIsSearchedUpwards) {
  EXPECT_EQ(find(*b, "x"), "/a/x");
  EXPECT_EQ(find(*b, "top"), "/top");
  EXPECT_EQ(find(*b, "c/x"), "/c/x");
}

TEST_F(PathTest, laterStepsAreNot) {
  EXPECT_EQ(find(*b, "c/top").substr(0, 1), "?");
  EXPECT_EQ(find(*b, "./x").substr(0, 1), "?");
}

TEST_F(PathTest, dotsAndAbsolutePaths) {
  EXPECT_EQ(find(*b, ".."), "/a");
  EXPECT_EQ(find(*b, "../"), "/a");
  EXPECT_EQ(find(*b, "../../c/x"), "/c/x");
  EXPECT_EQ(find(*b, "/"), "/");
  EXPECT_EQ(find(*b, "/c/x"), "/c/x");
  EXPECT_EQ(find(*b, "../../..").substr(0, 1), "?");
}

TEST_F(PathTest, bracketsCountBackwards) {
  const Component* y = a->components()[1].get();
  EXPECT_EQ(find(*a, "[-1]", y), "/a/x");
  EXPECT_EQ(find(*a, "[-2]", y).substr(0, 1), "?");
  EXPECT_EQ(find(*a, "[1]", y).substr(0, 1), "?");
}

TEST_F(PathTest, nearMissesAreNamed) {
  EXPECT_NE(find(*b, "/topp").find("did you mean 'top'"), std::string::npos) << find(*b, "/topp");
}

TEST(Path, splitsAtTheLastDotBehindTheLastSlash) {
  const auto split = [](std::string_view path) {
    const PathParts p = splitPath(path);
    return std::string(p.object) + "|" + std::string(p.attribute);
  };
  EXPECT_EQ(split("a/b.c"), "a/b|c");
  EXPECT_EQ(split("a.b/c"), "a.b/c|");
  EXPECT_EQ(split(".."), "..|");
  EXPECT_EQ(split("../."), "../.|");
  EXPECT_EQ(split("[-1].x"), "[-1]|x");
  EXPECT_EQ(split("/.dt"), "/|dt");
}

}  // namespace
}  // namespace stroma::test
