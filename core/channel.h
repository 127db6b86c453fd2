// SPDX-License-Identifier: Apache-2.0
// Values from one thread to another without locks, waiting or allocation.
//
// TripleBuffer hands over the newest value and forgets older ones. It has exactly one writing and
// one reading thread; no call ever waits for the other side (it is wait-free).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace stroma {

// A value that owns nothing: copying it neither allocates nor fails. (Eigen's vectors of fixed size
// are such, though not "trivially copyable" by the letter.)
template <class T>
concept PlainMessage = std::is_trivially_destructible_v<T> && std::is_default_constructible_v<T> &&
    std::is_copy_assignable_v<T>;

template <PlainMessage T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  // Writer: makes the value the newest one.
  void write(const T& value) noexcept {
    slots_[writing_] = value;
    const auto old =
        shared_.exchange(static_cast<std::uint8_t>(writing_ | fresh), std::memory_order_acq_rel);
    writing_ = old & slotMask;
  }

  // Reader: copies the newest value and returns true; false, `value` unchanged, when there is none
  // since the last call.
  [[nodiscard]] bool read(T& value) noexcept {
    if (!(shared_.load(std::memory_order_relaxed) & fresh)) return false;
    const auto old =
        shared_.exchange(static_cast<std::uint8_t>(reading_), std::memory_order_acq_rel);
    reading_ = old & slotMask;
    value = slots_[reading_];
    return true;
  }

 private:
  static constexpr std::uint8_t slotMask = 3, fresh = 4;
  // the writer owns one slot, the reader another, and the third lies between them
  std::array<T, 3> slots_{};
  alignas(64) std::atomic<std::uint8_t> shared_{2};
  alignas(64) std::uint8_t writing_ = 0;
  alignas(64) std::uint8_t reading_ = 1;
};

}  // namespace stroma
