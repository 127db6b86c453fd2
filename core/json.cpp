// SPDX-License-Identifier: Apache-2.0
#include "core/json.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/utf8.h"

namespace stroma {
namespace {

template <class T>
void appendNumber(std::string& text, T number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  text.append(buffer.data(), end);
}

}  // namespace

// A comma stands before whatever follows a value within the same object or array.
void JsonWriter::separate() {
  if (needsComma_) text_ += ',';
  needsComma_ = true;
}

JsonWriter& JsonWriter::beginObject() {
  separate();
  text_ += '{';
  needsComma_ = false;
  return *this;
}

JsonWriter& JsonWriter::endObject() {
  text_ += '}';
  needsComma_ = true;
  return *this;
}

JsonWriter& JsonWriter::beginArray() {
  separate();
  text_ += '[';
  needsComma_ = false;
  return *this;
}

JsonWriter& JsonWriter::endArray() {
  text_ += ']';
  needsComma_ = true;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  writeString(name);
  text_ += ':';
  needsComma_ = false;
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  if (!std::isfinite(number)) return null();
  separate();
  appendNumber(text_, number);
  return *this;
}

JsonWriter& JsonWriter::value(bool flag) {
  separate();
  text_ += flag ? "true" : "false";
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view content) {
  separate();
  writeString(content);
  return *this;
}

JsonWriter& JsonWriter::null() {
  separate();
  text_ += "null";
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

JsonWriter& JsonWriter::writeSigned(std::int64_t number) {
  separate();
  appendNumber(text_, number);
  return *this;
}

JsonWriter& JsonWriter::writeUnsigned(std::uint64_t number) {
  separate();
  appendNumber(text_, number);
  return *this;
}

void JsonWriter::writeString(std::string_view content) {
  constexpr std::string_view hex = "0123456789abcdef";
  text_ += '"';
  while (!content.empty()) {
    const std::size_t size = characterSize(content);
    const std::string_view character = content.substr(0, size == 0 ? 1 : size);
    const auto code = static_cast<unsigned char>(character.front());
    if (size == 0) {
      text_ += "\xEF\xBF\xBD";
    } else if (code == '"' || code == '\\') {
      text_ += '\\';
      text_ += character;
    } else if (code == '\n') {
      text_ += "\\n";
    } else if (code == '\t') {
      text_ += "\\t";
    } else if (code < 0x20 || code == 0x7F) {
      text_ += "\\u00";
      text_ += hex[code >> 4];
      text_ += hex[code & 0xF];
    } else {
      text_ += character;
    }
    content.remove_prefix(character.size());
  }
  text_ += '"';
}

}  // namespace stroma
