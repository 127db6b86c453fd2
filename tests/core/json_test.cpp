// SPDX-License-Identifier: Apache-2.0
#include "core/json.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <random>

namespace stroma {
namespace {

template <class T>
std::string written(const T& value) {
  return JsonWriter().value(value).text();
}

TEST(JsonWriter, commasSeparateWhatFollows) {
  JsonWriter json;
  json.beginObject();
  json.member("a", 1).key("list").beginArray().value(1.5).value("x").beginArray().endArray();
  json.beginObject().endObject().endArray().member("flag", true).key("none").null();
  json.endObject();
  EXPECT_EQ(json.text(), R"({"a":1,"list":[1.5,"x",[],{}],"flag":true,"none":null})");
}

TEST(JsonWriter, emptyContainersHaveNoCommas) {
  EXPECT_EQ(JsonWriter().beginObject().endObject().text(), "{}");
  EXPECT_EQ(JsonWriter().beginArray().endArray().text(), "[]");
}

TEST(JsonWriter, numbersReadBackToTheSameBits) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 10000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    const std::string text = written(number);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(number)) << text;
  }
}

TEST(JsonWriter, numbersThatJsonLacksAreNull) {
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(written(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "null");
}

TEST(JsonWriter, integersKeepAllDigits) {
  EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(written(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(written(-3), "-3");
  EXPECT_EQ(written(std::size_t{4}), "4");
}

TEST(JsonWriter, stringsAreEscaped) {
  EXPECT_EQ(written("say \"a\\b\""), R"("say \"a\\b\"")");
  EXPECT_EQ(written("a\nb\tc\rd"), R"("a\nb\tc\u000dd")");
  EXPECT_EQ(written(std::string("a\0b\x1f\x7f", 5)), R"("a\u0000b\u001f\u007f")");
  EXPECT_EQ(written("µ€😀"), "\"µ€😀\"");
  EXPECT_EQ(JsonWriter().beginObject().member("a\"b", 1).endObject().text(), R"({"a\"b":1})");
}

TEST(JsonWriter, brokenUtf8IsReplaced) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(written("a\xFF"
                    "b"),
            "\"a" + replaced + "b\"");
  EXPECT_EQ(written("\xC3"), "\"" + replaced + "\"");                                // cut short
  EXPECT_EQ(written("\xC0\x80"), "\"" + replaced + replaced + "\"");                 // overlong
  EXPECT_EQ(written("\xED\xA0\x80"), "\"" + replaced + replaced + replaced + "\"");  // surrogate
}

}  // namespace
}  // namespace stroma
