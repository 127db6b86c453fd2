// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/message_reader.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace stroma::viewer {
namespace {

using Type = PageMessage::Type;

PageMessage read(const std::string& text) {
  PageMessage message;
  EXPECT_EQ(readMessage(text, message), "") << text;
  return message;
}

std::string problemOf(const std::string& text) {
  PageMessage message;
  return readMessage(text, message);
}

TEST(PageMessage, isReadMemberByMember) {
  const PageMessage set = read(R"({"type":"set","n":7,"path":"/a.b","value":"3 kPa"})");
  EXPECT_EQ(set.type, Type::set);
  EXPECT_EQ(set.n, 7u);
  EXPECT_EQ(set.path, "/a.b");
  EXPECT_EQ(set.text, "3 kPa");
  EXPECT_TRUE(set.steers());
  const PageMessage pose = read(
      R"({"type":"pose","tool":"/t","p":[1e-3,2,-3],"q":[0,0,1.001,0],"buttons":1,"jump":true})");
  EXPECT_EQ(pose.pose.position, Vec3(1e-3, 2, -3));
  EXPECT_DOUBLE_EQ(pose.pose.orientation.z(), 1);
  EXPECT_TRUE(pose.jump);
  EXPECT_EQ(pose.buttons, 1u);
  EXPECT_FALSE(read(R"({"type":"look","body":3,"field":"vonMises","particles":true})").steers());
  EXPECT_EQ(read(R"({"type":"play"})").n, 0u);
}

TEST(PageMessage, tellsWhatIsWrong) {
  for (const char* text :
       {"",
        "[]",
        "null",
        "{",
        "{}",
        R"({"type":7})",
        R"({"type":"fly"})",
        R"({"type":"set"})",
        R"({"type":"set","path":"/a","value":3})",
        R"({"type":"speed","value":0})",
        R"({"type":"speed","value":-1})",
        R"({"type":"speed","value":"1"})",
        R"({"type":"speed","value":1e999})",
        R"({"type":"step","count":1.5})",
        R"({"type":"step","count":0})",
        R"({"type":"step","count":1e9})",
        R"({"type":"play","n":0})",
        R"({"type":"play","n":-1})",
        R"({"type":"play","n":"1"})",
        R"({"type":"pose","tool":"/t","p":[1,2],"q":[0,0,0,1],"buttons":0})",
        R"({"type":"pose","tool":"/t","p":[1,2,null],"q":[0,0,0,1],"buttons":0})",
        R"({"type":"pose","tool":"/t","p":[1,2,1e300],"q":[0,0,0,1],"buttons":0})",
        R"({"type":"pose","tool":"/t","p":[1,2,3],"q":[0,0,0,0],"buttons":0})",
        R"({"type":"pose","tool":"/t","p":[1,2,3],"q":[0,0,0,1],"buttons":-1})",
        R"({"type":"pose","tool":"/t","p":[1,2,3],"q":[0,0,0,1]})",
        R"({"type":"equip","tool":"laser","surface":"/a"})",
        R"({"type":"save","what":"all"})",
        R"({"type":"look","body":-1,"field":"","particles":false})",
        R"({"type":"look","body":0,"field":"","particles":1})",
        R"({"type":"neighbours","body":0,"particle":4294967296})",
        "{\"type\":\"pl\xff\"}"}) {
    EXPECT_NE(problemOf(text), "") << text;
  }
  EXPECT_NE(problemOf(std::string(100000, '[')), "");
  EXPECT_NE(problemOf("{\"type\":" + std::string(100000, '{')), "");
}

// Whatever is changed in a good message: it is read or refused, and what is read is finite.
TEST(PageMessage, survivesEveryMutation) {
  const std::string good =
      R"({"type":"pose","n":12,"tool":"/hand/probe","p":[0.001,-2,3],"q":[0,0,0,1],"buttons":1})";
  UniformRandom random(5);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() * static_cast<double>(n)) % n;
  };
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (std::size_t k = 0; k <= below(3); ++k) {
      const std::size_t at = below(text.size());
      constexpr std::string_view letters = "{}[]\",:0123456789-+eE.tfn\\ \x80\xff";
      if (random() < 0.5)
        text[at] = letters[below(letters.size())];
      else if (random() < 0.5)
        text.erase(at, 1 + below(4));
      else
        text.insert(at, 1, letters[below(letters.size())]);
      if (text.empty()) text = "x";
    }
    PageMessage message;
    if (!readMessage(text, message).empty()) continue;
    ++read;
    EXPECT_TRUE(message.pose.position.allFinite());
    EXPECT_NEAR(message.pose.orientation.norm(), 1, 1e-9);
  }
  EXPECT_GT(read, 1000);
}

}  // namespace
}  // namespace stroma::viewer
