// SPDX-License-Identifier: Apache-2.0
// Channels between two threads: no value is torn, lost (ring) or out of order.
#include "core/channel.h"

#include <gtest/gtest.h>

#include <thread>

namespace stroma {
namespace {

// All numbers are the same in a value that is not torn.
struct Message {
  std::array<std::uint64_t, 24> numbers{};
  static Message of(std::uint64_t number) {
    Message m;
    m.numbers.fill(number);
    return m;
  }
  [[nodiscard]] bool whole() const {
    for (const auto n : numbers) {
      if (n != numbers[0]) return false;
    }
    return true;
  }
};

TEST(TripleBuffer, theNewestValueIsReadOnce) {
  TripleBuffer<int> buffer;
  int value = 7;
  EXPECT_FALSE(buffer.read(value));
  EXPECT_EQ(value, 7);
  buffer.write(1);
  buffer.write(2);
  EXPECT_TRUE(buffer.read(value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(buffer.read(value));
  for (int i = 3; i < 100; ++i) {
    buffer.write(i);
    if (i % 3 == 0) {
      ASSERT_TRUE(buffer.read(value));
      ASSERT_EQ(value, i);
    }
  }
}

TEST(TripleBuffer, valuesAreWholeAndRiseBetweenThreads) {
  constexpr std::uint64_t count = 200'000;
  TripleBuffer<Message> buffer;
  std::atomic<bool> begun = false;
  std::jthread writer([&] {
    while (!begun) std::this_thread::yield();
    for (std::uint64_t i = 1; i <= count; ++i) {
      buffer.write(Message::of(i));
      if (i % 100 == 0) std::this_thread::yield();  // both get on, with one processor too
    }
  });
  begun = true;
  std::uint64_t torn = 0, back = 0, reads = 0, last = 0;
  Message value;
  while (last < count) {
    if (!buffer.read(value)) {
      std::this_thread::yield();
      continue;
    }
    ++reads;
    torn += value.whole() ? 0 : 1;
    back += value.numbers[0] <= last ? 1 : 0;
    last = value.numbers[0];
  }
  std::printf("%llu of %llu values read\n", static_cast<unsigned long long>(reads),
              static_cast<unsigned long long>(count));
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(back, 0u);
}

}  // namespace
}  // namespace stroma
