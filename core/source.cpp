// SPDX-License-Identifier: Apache-2.0
#include "core/source.h"

#include <algorithm>
#include <utility>

namespace stroma {
namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

// Every byte but the second to fourth of a UTF-8 sequence starts a character.
int countCharacters(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

}  // namespace

SourceText::SourceText(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)) {
  lineStarts_.push_back(text_.starts_with(byteOrderMark) ? byteOrderMark.size() : 0);
  for (std::size_t end = text_.find('\n'); end != std::string::npos;
       end = text_.find('\n', end + 1)) {
    lineStarts_.push_back(end + 1);
  }
}

std::size_t SourceText::lineIndex(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(lineStarts_, offset);
  return next == lineStarts_.begin() ? 0 : static_cast<std::size_t>(next - lineStarts_.begin()) - 1;
}

SourceText::Position SourceText::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const std::size_t index = lineIndex(offset);
  const std::size_t start = lineStarts_[index];
  const std::size_t length = offset > start ? offset - start : 0;
  return {static_cast<int>(index) + 1, countCharacters(text().substr(start, length)) + 1};
}

std::string_view SourceText::line(int line) const {
  if (line < 1 || line > lineCount()) return {};
  const auto index = static_cast<std::size_t>(line) - 1;
  const std::size_t start = lineStarts_[index];
  std::size_t end = index + 1 < lineStarts_.size() ? lineStarts_[index + 1] - 1 : text_.size();
  if (end > start && text_[end - 1] == '\r') --end;
  return text().substr(start, end - start);
}

std::string SourceRange::text() const {
  if (!source) return {};
  if (source->text().empty()) return source->name();
  const auto [line, column] = source->position(offset);
  return source->name() + ":" + std::to_string(line) + ":" + std::to_string(column);
}

}  // namespace stroma
