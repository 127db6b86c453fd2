// SPDX-License-Identifier: Apache-2.0
// Writes JSON (RFC 8259) text piece by piece. Commas, quotes and escapes are the writer's business;
// that begin and end match, and that keys stand in objects only, is the caller's.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stroma {

class JsonWriter {
 public:
  JsonWriter& beginObject();
  JsonWriter& endObject();
  JsonWriter& beginArray();
  JsonWriter& endArray();
  JsonWriter& key(std::string_view name);

  // Shortest text that reads back to the same bits; null for NaN and infinities.
  JsonWriter& value(double number);
  JsonWriter& value(bool flag);
  template <std::integral T>
  requires(!std::same_as<T, bool>) JsonWriter& value(T number) {
    if constexpr (std::signed_integral<T>)
      return writeSigned(number);
    else
      return writeUnsigned(number);
  }
  // Bytes that are not UTF-8 become U+FFFD, since JSON has no way to hold them.
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& null();
  // Text that is JSON already, as one value.
  JsonWriter& raw(std::string_view json);

  template <class T>
  JsonWriter& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  JsonWriter& writeSigned(std::int64_t number);
  JsonWriter& writeUnsigned(std::uint64_t number);
  void separate();
  void writeString(std::string_view content);

  std::string text_;
  bool needsComma_ = false;
};

}  // namespace stroma
