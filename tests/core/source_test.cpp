// SPDX-License-Identifier: Apache-2.0
#include "core/source.h"

#include <gtest/gtest.h>

namespace stroma {
namespace {

void expectPosition(const SourceText& source, std::size_t offset, int line, int column) {
  const auto position = source.position(offset);
  EXPECT_EQ(position.line, line) << "offset " << offset;
  EXPECT_EQ(position.column, column) << "offset " << offset;
}

TEST(SourceText, positionsCountFromOne) {
  const SourceText source("a.xml", "ab\ncd\n\nx");
  expectPosition(source, 0, 1, 1);
  expectPosition(source, 1, 1, 2);
  expectPosition(source, 2, 1, 3);  // the line's end belongs to it
  expectPosition(source, 3, 2, 1);
  expectPosition(source, 6, 3, 1);
  expectPosition(source, 7, 4, 1);
  EXPECT_EQ(source.lineCount(), 4);
}

TEST(SourceText, offsetsBeyondTheEndAreClamped) {
  const SourceText source("a.xml", "ab\ncd");
  expectPosition(source, 5, 2, 3);
  expectPosition(source, 1000, 2, 3);
  expectPosition(SourceText("empty", ""), 7, 1, 1);
}

TEST(SourceText, linesComeWithoutTheirEnd) {
  const SourceText source("a.xml", "one\r\ntwo\n\r\nlast");
  EXPECT_EQ(source.line(1), "one");
  EXPECT_EQ(source.line(2), "two");
  EXPECT_EQ(source.line(3), "");
  EXPECT_EQ(source.line(4), "last");
  EXPECT_EQ(source.line(0), "");
  EXPECT_EQ(source.line(5), "");
  EXPECT_EQ(source.line(-1), "");
}

TEST(SourceText, textThatEndsWithANewlineHasAnEmptyLastLine) {
  const SourceText source("a.xml", "one\n");
  EXPECT_EQ(source.lineCount(), 2);
  EXPECT_EQ(source.line(2), "");
  expectPosition(source, 4, 2, 1);
}

TEST(SourceText, crlfDoesNotShiftPositions) {
  const SourceText source("a.xml", "ab\r\ncd");
  expectPosition(source, 4, 2, 1);
  expectPosition(source, 5, 2, 2);
}

TEST(SourceText, columnsCountCharactersNotBytes) {
  const SourceText source("a.xml", "\u00B5\u20AC\U0001F600x\n\tz");  // 2, 3 and 4 bytes, then x
  expectPosition(source, 2, 1, 2);
  expectPosition(source, 5, 1, 3);
  expectPosition(source, 9, 1, 4);
  expectPosition(source, 12, 2, 2);  // a tab is one column
}

TEST(SourceText, byteOrderMarkBelongsToNoColumn) {
  const SourceText source("a.xml", "\xEF\xBB\xBF<Node/>\nx");
  expectPosition(source, 0, 1, 1);
  expectPosition(source, 3, 1, 1);
  expectPosition(source, 4, 1, 2);
  expectPosition(source, 11, 2, 1);
  EXPECT_EQ(source.line(1), "<Node/>");
}

TEST(SourceText, lineStartGivesTheOffset) {
  const SourceText source("a.xml", "ab\ncd\nef");
  EXPECT_EQ(source.line(3).data() - source.text().data(), 6);
}

TEST(SourceRange, textNamesThePlace) {
  const auto source = std::make_shared<SourceText>("scenes/a.xml", "one\ntwo");
  EXPECT_EQ((SourceRange{source, 5, 1}.text()), "scenes/a.xml:2:2");
  EXPECT_TRUE((SourceRange{source, 5, 1}));
  EXPECT_FALSE(SourceRange{});
  EXPECT_EQ(SourceRange{}.text(), "");
  EXPECT_EQ((SourceRange{std::make_shared<SourceText>("--set", "")}.text()), "--set");
}

}  // namespace
}  // namespace stroma
