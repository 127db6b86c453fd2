// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/frame_encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace stroma::viewer {
namespace {

using Json = nlohmann::json;

// Reads a message as a page does.
struct Decoded {
  std::uint32_t kind = 0;
  Json header;
  std::string payload;

  explicit Decoded(const std::string& bytes) {
    std::uint32_t size = 0;
    std::memcpy(&kind, bytes.data(), 4);
    std::memcpy(&size, bytes.data() + 4, 4);
    EXPECT_EQ(size % 4, 0u);
    header = Json::parse(bytes.substr(8, size));
    payload = bytes.substr(8 + size);
  }
  template <class T>
  [[nodiscard]] std::vector<T> numbers(const Json& array) const {
    const std::size_t offset = array.at("offset"), count = array.at("count");
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + count * sizeof(T), payload.size());
    std::vector<T> values(count);
    std::memcpy(values.data(), payload.data() + offset, count * sizeof(T));
    return values;
  }
};

TEST(FrameEncoder, aTopologyIsReadBackAsItWas) {
  TopologyCopy topology{3,      2, 9, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 0, 2, 3},
                        {0, 1}, {}};
  const Decoded read(encode(topology));
  EXPECT_EQ(read.kind, 1u);
  EXPECT_EQ(read.header.at("generation"), 3);
  EXPECT_EQ(read.header.at("body"), 2);
  EXPECT_EQ(read.header.at("revision"), 9);
  const Json& arrays = read.header.at("arrays");
  ASSERT_EQ(arrays.size(), 4u);
  EXPECT_EQ(read.numbers<float>(arrays[0]), topology.rest);
  EXPECT_EQ(read.numbers<std::uint32_t>(arrays[1]), topology.triangles);
  EXPECT_EQ(read.numbers<std::uint32_t>(arrays[2]), (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(read.numbers<std::uint8_t>(arrays[3]), topology.walls);
}

TEST(FrameEncoder, positionsAreWithinHalfAStepOfTheirBox) {
  FrameCopy frame;
  frame.step = 12;
  frame.time = 0.5;
  BodyCopy body{1, 4, {}, {{"stress", {1.5f, 2.5f}}}};
  for (int i = 0; i < 3000; ++i) {
    body.positions.push_back(0.01f * std::sin(0.7f * static_cast<float>(i)) +
                             5.0f * static_cast<float>(i % 3));
  }
  frame.bodies.push_back(body);
  const Decoded read(encode(frame));
  EXPECT_EQ(read.kind, 2u);
  const Json& arrays = read.header.at("bodies").at(0).at("arrays");
  const Json& position = arrays[0];
  EXPECT_EQ(position.at("type"), "u16box");
  const auto numbers = read.numbers<std::uint16_t>(position);
  ASSERT_EQ(numbers.size(), body.positions.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const float low = position.at("low").at(i % 3), high = position.at("high").at(i % 3);
    const float back = low + (high - low) * static_cast<float>(numbers[i]) / 65535.0f;
    EXPECT_NEAR(back, body.positions[i], 0.51 * (high - low) / 65535 + 1e-6);
  }
  EXPECT_EQ(arrays[1].at("field"), "stress");
  EXPECT_EQ(read.numbers<float>(arrays[1]), (std::vector<float>{1.5f, 2.5f}));
}

TEST(FrameEncoder, aFlatBodyAndNoNumbersAreNoTrouble) {
  FrameCopy frame;
  const float none = std::numeric_limits<float>::quiet_NaN();
  frame.bodies = {
      {0, 0, {1, 2, 3, 4, 2, 3}, {}}, {1, 0, {none, 0, 1, 2, none, 1}, {}}, {2, 0, {}, {}}};
  const Decoded read(encode(frame));
  const auto flat = read.numbers<std::uint16_t>(read.header.at("bodies").at(0).at("arrays").at(0));
  EXPECT_EQ(flat, (std::vector<std::uint16_t>{0, 0, 0, 65535, 0, 0}));
  EXPECT_EQ(read.header.at("bodies").size(), 3u);
}

TEST(FrameEncoder, piecesAreWhatTrianglesJoin) {
  const std::vector<std::uint32_t> triangles{4, 5, 6, 0, 1, 2, 2, 3, 0, 6, 5, 7};
  EXPECT_EQ(piecesOf(triangles, 9), (std::vector<std::uint32_t>{0, 1, 1, 0}));
}

}  // namespace
}  // namespace stroma::viewer
