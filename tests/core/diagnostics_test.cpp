// SPDX-License-Identifier: Apache-2.0
#include "core/diagnostics.h"

#include <gtest/gtest.h>

#include <chrono>

namespace stroma {
namespace {

std::shared_ptr<const SourceText> text(std::string name, std::string content) {
  return std::make_shared<SourceText>(std::move(name), std::move(content));
}

SourceRange find(const std::shared_ptr<const SourceText>& source, std::string_view piece) {
  return {source, source->text().find(piece), piece.size()};
}

TEST(Diagnostics, caretsStandUnderTheMistake) {
  const auto scene = text("scenes/liver.xml",
                          "<Node>\n"
                          "    <MLSForceField name=\"fem\" yougModulus=\"3000\"/>\n"
                          "</Node>\n");
  const Diagnostic diagnostic{Severity::error, "attr-unknown", "unknown attribute 'yougModulus'",
                              find(scene, "yougModulus"), "did you mean 'youngModulus'?"};
  EXPECT_EQ(format(diagnostic),
            "scenes/liver.xml:2:31: error: unknown attribute 'yougModulus'  [attr-unknown]\n"
            "    2 |     <MLSForceField name=\"fem\" yougModulus=\"3000\"/>\n"
            "      |                               ^~~~~~~~~~~\n"
            "      = did you mean 'youngModulus'?\n");
}

TEST(Diagnostics, placesWithoutTextHaveNoExcerpt) {
  Diagnostic diagnostic{Severity::warning, "w", "careful", {}, ""};
  EXPECT_EQ(format(diagnostic), "warning: careful  [w]\n");
  diagnostic.where = {text("--set", ""), 0, 0};
  EXPECT_EQ(format(diagnostic), "--set: warning: careful  [w]\n");
}

TEST(Diagnostics, hintsMayHaveSeveralLines) {
  EXPECT_EQ(format({Severity::note, "n", "m", {}, "one\ntwo"}),
            "note: m  [n]\n      = one\n      = two\n");
}

TEST(Diagnostics, caretsCountCharacters) {
  const auto source = text("a", "µµ\tbad\r\n");
  EXPECT_EQ(format({Severity::error, "e", "m", find(source, "bad"), ""}),
            "a:1:4: error: m  [e]\n    1 | µµ bad\n      |    ^~~\n");
}

TEST(Diagnostics, controlCharactersAreEscaped) {
  const auto source = text("a\x1b[31m", "x\x1b[2Jy\xFFz\x7F\u0085w");
  const std::string shown = format({Severity::error, "e", "a\nb\x07\xC3", find(source, "z"), ""});
  EXPECT_EQ(shown,
            "a\\x1b[31m:1:8: error: a\\x0ab\\x07\\xc3  [e]\n"
            "    1 | x\\x1b[2Jy\\xffz\\x7f\\xc2\\x85w\n"
            "      |              ^\n");
}

TEST(Diagnostics, longLinesAreWindowed) {
  const auto source = text("a", std::string(100'000'000, '7') + "x" + std::string(1000, '8'));
  const auto begin = std::chrono::steady_clock::now();
  const std::string shown = format({Severity::error, "e", "m", {source, 100'000'000, 500}, ""});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  RecordProperty("seconds", std::to_string(took.count()));
  EXPECT_LT(took.count(), 2.0);
  EXPECT_LT(shown.size(), 600u);
  EXPECT_NE(shown.find("a:1:100000001: error"), std::string::npos);
  EXPECT_NE(shown.find("    1 | ...777"), std::string::npos);
  EXPECT_NE(shown.find("7x8"), std::string::npos);
  EXPECT_NE(shown.find("888...\n"), std::string::npos);
  // the caret stands under the x
  const std::size_t excerpt = shown.find("    1 | ");
  const std::size_t carets = shown.find("      | ", excerpt);
  EXPECT_EQ(shown.find('^') - carets, shown.find('x', excerpt) - excerpt);
}

TEST(Diagnostics, windowsCutBetweenCharacters) {
  std::string line;
  for (int i = 0; i < 1000; ++i) line += "€";
  for (const std::size_t offset : {0, 3, 300, 1500, 2997, 3000}) {
    const std::string shown = format({Severity::error, "e", "m", {text("a", line), offset, 3}, ""});
    EXPECT_EQ(shown.find("\\x"), std::string::npos) << shown;
    EXPECT_NE(shown.find('^'), std::string::npos);
  }
}

TEST(Diagnostics, rangesEndWithTheirLine) {
  const auto source = text("a", "ab\ncd\nef");
  EXPECT_EQ(format({Severity::error, "e", "m", {source, 4, 100}, ""}),
            "a:2:2: error: m  [e]\n    2 | cd\n      |  ^\n");
  EXPECT_EQ(format({Severity::error, "e", "m", {source, 999, 5}, ""}),
            "a:3:3: error: m  [e]\n    3 | ef\n      |   ^\n");
}

TEST(Diagnostics, textIsOrderedByFileLineAndColumn) {
  const auto first = text("z.xml", "abc\ndef");
  const auto second = text("a.xml", "xyz");
  Diagnostics diagnostics;
  diagnostics.error("e", "third", find(first, "f"));
  diagnostics.error("e", "fourth", find(second, "y"));
  diagnostics.warning("w", "second", find(first, "d"));
  diagnostics.note("n", "first", find(first, "b"));
  const std::string shown = diagnostics.text();
  const auto at = [&](std::string_view word) { return shown.find(word); };
  EXPECT_LT(at("first"), at("second"));
  EXPECT_LT(at("second"), at("third"));
  EXPECT_LT(at("third"), at("fourth"));
  EXPECT_TRUE(shown.ends_with("\n2 errors, 1 warning; nothing was started.\n")) << shown;
  EXPECT_EQ(diagnostics.all().front().message, "third");
}

TEST(Diagnostics, warningsAloneHaveNoSummary) {
  Diagnostics diagnostics;
  EXPECT_EQ(diagnostics.text(), "");
  diagnostics.warning("w", "careful");
  EXPECT_EQ(diagnostics.text(), "warning: careful  [w]\n");
  EXPECT_EQ(diagnostics.errorCount(), 0);
  EXPECT_EQ(diagnostics.warningCount(), 1);
}

TEST(Diagnostics, onlySoManyAreKept) {
  Diagnostics diagnostics;
  for (int i = 0; i < 100'000; ++i) diagnostics.error("e", std::string(10'000, 'm'));
  diagnostics.warning("w", "still seen");
  EXPECT_EQ(diagnostics.errorCount(), 100'000);
  EXPECT_EQ(diagnostics.all().size(), 201u);
  const std::string shown = diagnostics.text();
  EXPECT_LT(shown.size(), 300'000u);
  EXPECT_NE(shown.find("still seen"), std::string::npos);
  EXPECT_NE(shown.find("... and 99800 more problems.\n100000 errors, 1 warning"),
            std::string::npos);
}

TEST(Diagnostics, jsonHasPlacesForEditors) {
  Diagnostics diagnostics;
  const auto source = text("a.xml", "one\nµ \"two\"");
  diagnostics.error("e-id", "bad \"two\"", find(source, "two"), "hint");
  diagnostics.warning("w", "no place");
  EXPECT_EQ(diagnostics.json(),
            R"({"errors":1,"warnings":1,"omitted":0,"diagnostics":[)"
            R"({"severity":"error","id":"e-id","message":"bad \"two\"","file":"a.xml",)"
            R"("line":2,"column":4,"endLine":2,"endColumn":7,"hint":"hint",)"
            R"("excerpt":"    2 | µ \"two\"\n      |    ^~~\n"},)"
            R"({"severity":"warning","id":"w","message":"no place"}]})");
}

TEST(Quoted, textIsShortenedAndEscaped) {
  EXPECT_EQ(quoted("abc"), "'abc'");
  EXPECT_EQ(quoted("abcdef", 3), "'abc...'");
  EXPECT_EQ(quoted("µµ", 2), "'µµ'");
  EXPECT_EQ(quoted("a\nb"), "'a\\x0ab'");
}

TEST(NearestNames, oneEditOfAnyKindIsNear) {
  const std::vector<std::string> names{"poissonRatio", "youngModulus", "density"};
  const std::vector<std::string> expected{"youngModulus"};
  for (const std::string_view wrong :
       {"yougModulus", "youungModulus", "yuongModulus", "yoangModulus", "YOUNGMODULUS"}) {
    EXPECT_EQ(nearestNames(wrong, names), expected) << wrong;
  }
}

TEST(NearestNames, bestComesFirst) {
  const std::vector<std::string> names{"positions", "position", "rest_position", "rotation"};
  const auto near = nearestNames("positon", names);
  ASSERT_GE(near.size(), 2u);
  EXPECT_EQ(near[0], "position");
  EXPECT_EQ(near[1], "positions");
  EXPECT_EQ(nearestNames("positon", names, 1).size(), 1u);
}

TEST(NearestNames, aSwapCountsOnce) {
  const std::vector<std::string> names{"abx", "ba"};
  EXPECT_EQ(nearestNames("ab", names).size(), 2u);
}

TEST(NearestNames, whatIsFarIsNotNamed) {
  const std::vector<std::string> names{"youngModulus", "x", "dt", ""};
  EXPECT_TRUE(nearestNames("gravity", names).empty());
  EXPECT_TRUE(nearestNames("y", names).empty());  // one letter of one
  EXPECT_TRUE(nearestNames("", names).empty());
  EXPECT_EQ(didYouMean("dx", names), "did you mean 'dt'?");
  EXPECT_EQ(didYouMean("gravity", names), "");
}

TEST(NearestNames, hugeWordsCostNothing) {
  const std::vector<std::string> names(10, std::string(1'000'000, 'a'));
  EXPECT_TRUE(nearestNames(std::string(1'000'000, 'a'), names).empty());
  EXPECT_TRUE(nearestNames("aaa", names).empty());
  EXPECT_EQ(nearestNames(std::string(64, 'a'), std::vector{std::string(63, 'a')}).size(), 1u);
}

}  // namespace
}  // namespace stroma
