// SPDX-License-Identifier: Apache-2.0
#include "tools/study/scene_edit.h"

#include <gtest/gtest.h>

namespace stroma::study {
namespace {

const char* const scene =
    "<Node name=\"root\"><Node name=\"beam\"><A name=\"first\" x=\"1 &lt; 2\"/><B/></Node></Node>";

SceneElement parsed(const std::string& text) {
  Diagnostics diagnostics;
  auto element = parseSceneText(std::make_shared<SourceText>("test", text), diagnostics);
  EXPECT_TRUE(element) << diagnostics.text();
  return element.value_or(SceneElement{});
}

std::string edited(Edit::Kind kind, const std::string& target, Diagnostics& diagnostics) {
  SceneElement root = parsed(scene);
  Edit one;
  one.kind = kind;
  one.target = target;
  one.elements.push_back(parsed("<C name=\"new\"/>"));
  edit(root, {one}, diagnostics);
  return sceneText(root);
}

TEST(SceneEdit, textReadsBackAsTheSameElements) {
  const std::string text = sceneText(parsed(scene));
  EXPECT_EQ(sceneText(parsed(text)), text);
  EXPECT_NE(text.find("x=\"1 &lt; 2\""), std::string::npos) << text;
}

TEST(SceneEdit, replacesRemovesAndInsertsByPath) {
  Diagnostics none;
  EXPECT_NE(edited(Edit::Kind::replace, "/beam/first", none).find("<C name=\"new\"/>\n    <B/>"),
            std::string::npos);
  EXPECT_EQ(edited(Edit::Kind::remove, "/beam/B", none).find("<B/>"), std::string::npos);
  EXPECT_NE(edited(Edit::Kind::insert, "/beam", none).find("<B/>\n    <C name=\"new\"/>"),
            std::string::npos);
  EXPECT_NE(edited(Edit::Kind::insert, "/", none).find("</Node>\n  <C name=\"new\"/>"),
            std::string::npos);
  EXPECT_EQ(none.errorCount(), 0) << none.text();
}

TEST(SceneEdit, pathsThatNameNothingAreErrorsWithTheNearestName) {
  Diagnostics wrong;
  (void)edited(Edit::Kind::replace, "/beam/frist", wrong);
  (void)edited(Edit::Kind::remove, "/", wrong);
  (void)edited(Edit::Kind::insert, "/beam/B", wrong);
  EXPECT_EQ(wrong.errorCount(), 3);
  EXPECT_NE(wrong.text().find("did you mean 'first'?"), std::string::npos) << wrong.text();
}

}  // namespace
}  // namespace stroma::study
