// SPDX-License-Identifier: Apache-2.0
// Text that was read from somewhere, and places in it. Offsets count bytes; lines and columns are
// what an editor shows: 1-based, a column being one character (UTF-8 code point), a tab one too.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stroma {

// A named text, usually a file. A byte order mark belongs to no column; lines end at "\n", and a
// "\r" before it is not part of the line.
class SourceText {
 public:
  struct Position {
    int line = 1;
    int column = 1;
  };

  SourceText(std::string name, std::string text);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::string_view text() const { return text_; }

  // Offsets beyond the end give the position just after the last character.
  [[nodiscard]] Position position(std::size_t offset) const;

  // The line without its end; empty for a number outside the text. Points into text(), so that
  // line(n).data() - text().data() is the offset at which line n starts.
  [[nodiscard]] std::string_view line(int line) const;
  [[nodiscard]] int lineCount() const { return static_cast<int>(lineStarts_.size()); }

 private:
  [[nodiscard]] std::size_t lineIndex(std::size_t offset) const;

  std::string name_;
  std::string text_;
  std::vector<std::size_t> lineStarts_;
};

// A piece of a source. Without a source there is no location; a source with an empty text stands
// for a place that only has a name, such as "--set".
struct SourceRange {
  std::shared_ptr<const SourceText> source;
  std::size_t offset = 0;
  std::size_t length = 0;

  explicit operator bool() const { return source != nullptr; }
  // "file:line:column", only the name where the source has no text, "" without a source.
  [[nodiscard]] std::string text() const;
};

}  // namespace stroma
