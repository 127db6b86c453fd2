// SPDX-License-Identifier: Apache-2.0
#include "components/io/obj_records.h"

#include <cmath>

#include "components/io/mesh_text.h"
#include "core/diagnostics.h"

namespace stroma {
namespace {

constexpr std::size_t mostProblems = 20;

// a backslash continues a line and is no part of a word
constexpr std::string_view blanks = " \t\r\\";

class Scanner {
 public:
  void line(std::string_view rest, int number) {
    line_ = number;
    const std::string_view record = takeWord(rest, blanks);
    if (record == "v") point(rest);
    if (record == "vt") ++textureCount_;
    if (record == "vn") ++normalCount_;
    if (record == "f") face(rest, 3);
    if (record == "l") face(rest, 2);
  }
  [[nodiscard]] ObjRecords take() { return std::move(records_); }

 private:
  void problem(std::string message) {
    if (records_.problems.size() < mostProblems) {
      records_.problems.push_back({std::move(message), line_});
    }
  }

  void point(std::string_view rest) {
    Vec3 x = Vec3::Zero();
    for (double& coordinate : x) {
      const std::string_view word = takeWord(rest, blanks);
      if (!readNumber(word, coordinate)) {
        problem(word.empty() ? "the point has fewer than three coordinates"
                             : stroma::quoted(word) + " is not a number");
      } else if (!std::isfinite(coordinate)) {
        problem("the point has a coordinate that is not finite");
      }
    }
    records_.points.push_back(x);
  }

  void face(std::string_view rest, int fewest) {
    int corners = 0;
    for (std::string_view word = takeWord(rest, blanks); !word.empty();
         word = takeWord(rest, blanks)) {
      corner(word);
      ++corners;
    }
    if (corners < fewest) problem("the element has " + std::to_string(corners) + " points");
  }

  // "point", "point/texture", "point//normal" or "point/texture/normal", counted from 1, or from
  // the end when negative
  void corner(std::string_view word) {
    const std::size_t counts[] = {records_.points.size(), textureCount_, normalCount_};
    constexpr const char* names[] = {"point", "texture coordinate", "normal"};
    const std::string_view whole = word;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view digits = word.substr(0, slash);
      const bool optional = part > 0 && digits.empty();
      long long index = 0;
      const auto count = static_cast<long long>(counts[part]);
      if (!optional && !readNumber(digits, index))
        return problem(stroma::quoted(whole) + " is no index");
      if (!optional && (index == 0 || index > count || index < -count)) {
        return problem("index " + std::to_string(index) + " names no " + names[part] +
                       " (there are " + std::to_string(count) + " so far, counted from 1)");
      }
      if (part == 0) {
        records_.corners.push_back(static_cast<Index>(index > 0 ? index - 1 : count + index));
      }
      if (slash == word.size()) return;
      word.remove_prefix(slash + 1);
    }
    problem(stroma::quoted(whole) + " is no index");
  }

  ObjRecords records_;
  std::size_t textureCount_ = 0, normalCount_ = 0;
  int line_ = 0;
};

}  // namespace

ObjRecords scanObj(std::string_view text) {
  Scanner scanner;
  int number = 1;
  while (!text.empty()) {
    // a backslash at its end continues a line
    std::size_t end = std::min(text.find('\n'), text.size());
    int lines = 1;
    while (end < text.size() && end > 0 &&
           (text[end - 1] == '\\' || (end > 1 && text[end - 1] == '\r' && text[end - 2] == '\\'))) {
      end = std::min(text.find('\n', end + 1), text.size());
      ++lines;
    }
    std::string joined(text.substr(0, end));
    for (char& c : joined) c = c == '\n' ? ' ' : c;
    scanner.line(joined, number);
    number += lines;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return scanner.take();
}

}  // namespace stroma
