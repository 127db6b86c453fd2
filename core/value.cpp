// SPDX-License-Identifier: Apache-2.0
#include "core/value.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/diagnostics.h"
#include "core/number_list.h"

namespace stroma {
namespace {

using Result = std::optional<ParseError>;

ParseError wholeError(std::string_view text, std::string id, std::string message,
                      std::string hint = {}) {
  const std::size_t begin = skipBlanks(text, 0);
  return {begin, trimmed(text).size(), std::move(id), std::move(message), std::move(hint)};
}

std::string numbersText(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

ParseError tooFew(std::string_view text, std::size_t expected, std::size_t got,
                  std::string_view noun) {
  return wholeError(text, got == 0 ? "value-missing" : "value-count",
                    "expected " + numbersText(expected, noun) + ", got " +
                        (got == 0 ? "nothing" : std::to_string(got)));
}

ParseError notMultiple(std::string_view text, std::size_t of, std::size_t got,
                       std::string_view noun) {
  return wholeError(
      text, "value-count",
      "expected a multiple of " + numbersText(of, noun) + ", got " + std::to_string(got));
}

template <std::size_t count>
Result parseTuple(std::string_view text, const ValueContext& context,
                  std::array<double, count>& out) {
  std::vector<double> numbers;
  if (auto error = parseNumbers(text, context, count, numbers)) return error;
  if (numbers.size() < count) return tooFew(text, count, numbers.size(), "number");
  std::ranges::copy(numbers, out.begin());
  return std::nullopt;
}

// === bool, whole numbers, numbers, text

std::string typeName(const bool*) { return "true or false"; }

Result parseText(std::string_view text, const ValueContext&, bool& out) {
  const std::string_view word = trimmed(text);
  std::string lower(word.substr(0, 6));
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  int number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, status] = std::from_chars(word.data(), end, number);
  if (lower == "t" || lower == "true") {
    out = true;
  } else if (lower == "f" || lower == "false") {
    out = false;
  } else if (!word.empty() && status == std::errc() && stop == end) {
    out = number != 0;
  } else {
    return wholeError(text, word.empty() ? "value-missing" : "value-bool",
                      "expected true or false, got " + (word.empty() ? "nothing" : quoted(word)));
  }
  return std::nullopt;
}

void append(std::string& text, bool value) { text += value ? "true" : "false"; }

std::string typeName(const int*) { return "whole number"; }

Result parseText(std::string_view text, const ValueContext&, int& out) {
  std::vector<int> numbers;
  if (auto error = parseWholeNumbers(text, 1, numbers)) return error;
  if (numbers.empty()) return tooFew(text, 1, 0, "whole number");
  out = numbers.front();
  return std::nullopt;
}

template <class Number>
void appendNumber(std::string& text, Number value) {
  std::array<char, 32> buffer;
  text.append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

void append(std::string& text, int value) { appendNumber(text, value); }

std::string typeName(const double*) { return "number"; }

Result parseText(std::string_view text, const ValueContext& context, double& out) {
  std::array<double, 1> number;
  if (auto error = parseTuple(text, context, number)) return error;
  out = number[0];
  return std::nullopt;
}

void append(std::string& text, double value) { appendNumber(text, value); }

std::string typeName(const std::string*) { return "text"; }

Result parseText(std::string_view text, const ValueContext&, std::string& out) {
  out = text;
  return std::nullopt;
}

void append(std::string& text, const std::string& value) { text += value; }

std::string typeName(const FilePath*) { return "file"; }

Result parseText(std::string_view text, const ValueContext&, FilePath& out) {
  out.path = trimmed(text);
  return std::nullopt;
}

void append(std::string& text, const FilePath& value) { text += value.path; }

// === fixed numbers of numbers

std::string typeName(const Vec3*) { return "3 numbers"; }

Result parseText(std::string_view text, const ValueContext& context, Vec3& out) {
  std::array<double, 3> numbers;
  if (auto error = parseTuple(text, context, numbers)) return error;
  out = {numbers[0], numbers[1], numbers[2]};
  return std::nullopt;
}

void append(std::string& text, std::span<const double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += ' ';
    append(text, numbers[i]);
  }
}

void append(std::string& text, const Vec3& value) {
  append(text, std::span<const double>(value.data(), 3));
}

std::string typeName(const Quat*) { return "rotation (quaternion x y z w)"; }

Result parseText(std::string_view text, const ValueContext& context, Quat& out) {
  std::array<double, 4> q;
  if (auto error = parseTuple(text, context, q)) return error;
  const double norm = std::hypot(std::hypot(q[0], q[1], q[2]), q[3]);
  if (norm < 1e-100 || !std::isfinite(norm)) {
    return wholeError(text, "value-rotation", "a rotation needs a quaternion of finite length > 0");
  }
  // what is normalised already keeps its bits
  const double scale = std::abs(norm - 1) > 1e-14 ? norm : 1;
  out = Quat(q[3] / scale, q[0] / scale, q[1] / scale, q[2] / scale);
  return std::nullopt;
}

void append(std::string& text, const Quat& value) {
  append(text, std::span<const double>(value.coeffs().data(), 4));
}

std::string typeName(const Box*) { return "box (xmin ymin zmin xmax ymax zmax)"; }

Result parseText(std::string_view text, const ValueContext& context, std::vector<Box>& out) {
  std::vector<double> numbers;
  if (auto error = parseNumbers(text, context, anyCount, numbers)) return error;
  if (numbers.size() % 6 != 0) return notMultiple(text, 6, numbers.size(), "number");
  std::vector<Box> boxes(numbers.size() / 6);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double* const n = &numbers[6 * i];
    boxes[i] = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    if ((boxes[i].min.array() > boxes[i].max.array()).any()) {
      std::string shown;
      append(shown, std::span<const double>(n, 6));
      return wholeError(text, "value-box",
                        "box " + quoted(shown) + " has a minimum above its maximum",
                        "order: xmin ymin zmin xmax ymax zmax");
    }
  }
  out = std::move(boxes);
  return std::nullopt;
}

Result parseText(std::string_view text, const ValueContext& context, Box& out) {
  std::array<double, 6> counted;  // a wrong count is reported as for any tuple
  if (auto error = parseTuple(text, context, counted)) return error;
  std::vector<Box> boxes;
  if (auto error = parseText(text, context, boxes)) return error;
  out = boxes.front();
  return std::nullopt;
}

void append(std::string& text, const Box& value) {
  append(text, value.min);
  text += ' ';
  append(text, value.max);
}

// === colours

struct NamedColor {
  std::string_view name;
  Color color;
};

constexpr std::array<NamedColor, 23> namedColors{{
    {"white", {1, 1, 1, 1}},
    {"black", {0, 0, 0, 1}},
    {"red", {1, 0, 0, 1}},
    {"green", {0, 1, 0, 1}},
    {"blue", {0, 0, 1, 1}},
    {"cyan", {0, 1, 1, 1}},
    {"magenta", {1, 0, 1, 1}},
    {"yellow", {1, 1, 0, 1}},
    {"gray", {0.5, 0.5, 0.5, 1}},
    {"darkgray", {0.25, 0.25, 0.25, 1}},
    {"lightgray", {0.75, 0.75, 0.75, 1}},
    {"orange", {1, 0.5, 0, 1}},
    {"purple", {0.5, 0, 0.5, 1}},
    {"pink", {1, 0.75, 0.8, 1}},
    {"brown", {0.6, 0.3, 0.1, 1}},
    {"lime", {0.5, 1, 0, 1}},
    {"teal", {0, 0.5, 0.5, 1}},
    {"navy", {0, 0, 0.5, 1}},
    {"olive", {0.5, 0.5, 0, 1}},
    {"maroon", {0.5, 0, 0, 1}},
    {"silver", {0.75, 0.75, 0.75, 1}},
    {"gold", {1, 0.84, 0, 1}},
    {"azure", {0, 0.5, 1, 1}},
}};

std::string typeName(const Color*) { return "colour"; }

// "#rgb", "#rgba", "#rrggbb" or "#rrggbbaa"
Result parseHexColor(std::string_view text, Color& out) {
  const std::string_view digits = trimmed(text).substr(1);
  const std::size_t width = digits.size() <= 4 ? 1 : 2;
  const std::size_t count = digits.size() / width;
  std::array<double, 4> parts{0, 0, 0, 1};
  bool good = digits.size() % width == 0 && (count == 3 || count == 4);
  for (std::size_t i = 0; good && i < count; ++i) {
    unsigned part = 0;
    const char* const begin = digits.data() + i * width;
    const auto [stop, status] = std::from_chars(begin, begin + width, part, 16);
    good = status == std::errc() && stop == begin + width;
    parts[i] = part / (width == 1 ? 15.0 : 255.0);
  }
  if (!good) {
    return wholeError(text, "value-color", quoted(trimmed(text)) + " is not a colour",
                      "forms: #rgb, #rgba, #rrggbb, #rrggbbaa");
  }
  out = {parts[0], parts[1], parts[2], parts[3]};
  return std::nullopt;
}

Result parseNamedColor(std::string_view text, Color& out) {
  const std::string_view name = trimmed(text);
  std::vector<std::string> names;
  for (const NamedColor& named : namedColors) {
    if (named.name == name) {
      out = named.color;
      return std::nullopt;
    }
    names.emplace_back(named.name);
  }
  return wholeError(text, "value-color", quoted(name) + " is not a colour",
                    didYouMean(name, names));
}

Result parseText(std::string_view text, const ValueContext&, Color& out) {
  const std::string_view word = trimmed(text);
  if (word.starts_with('#')) return parseHexColor(text, out);
  const bool isName =
      !word.empty() && ((word[0] >= 'a' && word[0] <= 'z') || (word[0] >= 'A' && word[0] <= 'Z'));
  if (isName) return parseNamedColor(text, out);
  std::vector<double> parts;
  if (auto error = parseNumbers(text, {}, 4, parts)) return error;
  if (parts.size() < 3) {
    return wholeError(text, parts.empty() ? "value-missing" : "value-count",
                      "expected 3 or 4 numbers, a name or #rrggbb, got " +
                          (parts.empty() ? std::string("nothing") : std::to_string(parts.size())));
  }
  if (std::ranges::any_of(parts, [](double part) { return part < 0 || part > 1; })) {
    return wholeError(text, "value-color", "a colour's components lie between 0 and 1");
  }
  out = {parts[0], parts[1], parts[2], parts.size() == 4 ? parts[3] : 1.0};
  return std::nullopt;
}

void append(std::string& text, const Color& value) {
  append(text, std::array<double, 4>{value.r, value.g, value.b, value.a});
}

// === lists

std::string typeName(const IndexList*) { return "indices"; }

Result parseText(std::string_view text, const ValueContext&, IndexList& out) {
  std::vector<Index> indices;
  if (auto error = parseIndexRanges(text, indices)) return error;
  out.indices = std::move(indices);
  return std::nullopt;
}

// Runs of three and more are written as ranges.
void append(std::string& text, const IndexList& value) {
  const std::vector<Index>& list = value.indices;
  for (std::size_t i = 0, end = 0; i < list.size(); i = end) {
    for (end = i + 1; end < list.size() && list[end] - 1 == list[end - 1];) ++end;
    if (end - i < 3) end = i + 1;
    if (i > 0) text += ' ';
    append(text, list[i]);
    if (end > i + 1) {
      text += '-';
      append(text, list[end - 1]);
    }
  }
}

std::string typeName(const std::vector<double>*) { return "numbers"; }

Result parseText(std::string_view text, const ValueContext& context, std::vector<double>& out) {
  std::vector<double> numbers;
  if (auto error = parseNumbers(text, context, anyCount, numbers)) return error;
  out = std::move(numbers);
  return std::nullopt;
}

std::string typeName(const std::vector<int>*) { return "whole numbers"; }

Result parseText(std::string_view text, const ValueContext&, std::vector<int>& out) {
  std::vector<int> numbers;
  if (auto error = parseWholeNumbers(text, anyCount, numbers)) return error;
  out = std::move(numbers);
  return std::nullopt;
}

std::string typeName(const std::vector<Vec3>*) { return "list of 3 numbers each"; }

Result parseText(std::string_view text, const ValueContext& context, std::vector<Vec3>& out) {
  std::vector<double> numbers;
  if (auto error = parseNumbers(text, context, anyCount, numbers)) return error;
  if (numbers.size() % 3 != 0) return notMultiple(text, 3, numbers.size(), "number");
  out.resize(numbers.size() / 3);
  std::ranges::copy(numbers, out.empty() ? nullptr : out.front().data());
  return std::nullopt;
}

std::string typeName(const std::vector<std::string>*) { return "names"; }

Result parseText(std::string_view text, const ValueContext&, std::vector<std::string>& out) {
  out.clear();
  for (std::size_t at = skipBlanks(text, 0); at < text.size(); at = skipBlanks(text, at)) {
    const std::size_t end = tokenEnd(text, at);
    out.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return std::nullopt;
}

std::string typeName(const std::vector<Box>*) { return "boxes (xmin ymin zmin xmax ymax zmax)"; }

template <std::size_t n>
std::string typeName(const std::array<Index, n>*) {
  return numbersText(n, "whole number");
}

template <std::size_t n>
Result parseText(std::string_view text, const ValueContext&, std::array<Index, n>& out) {
  std::vector<Index> indices;
  if (auto error = parseIndices(text, n, indices)) return error;
  if (indices.size() < n) return tooFew(text, n, indices.size(), "whole number");
  std::ranges::copy(indices, out.begin());
  return std::nullopt;
}

template <std::size_t n>
void append(std::string& text, const std::array<Index, n>& value) {
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) text += ' ';
    append(text, value[i]);
  }
}

template <std::size_t n>
std::string typeName(const std::vector<std::array<Index, n>>*) {
  constexpr std::string_view kind = n == 2   ? "edges"
                                    : n == 3 ? "triangles"
                                    : n == 4 ? "tetrahedra or quads"
                                             : "hexahedra";
  return std::string(kind) + " (" + std::to_string(n) + " indices each)";
}

template <std::size_t n>
Result parseText(std::string_view text, const ValueContext&,
                 std::vector<std::array<Index, n>>& out) {
  std::vector<Index> indices;
  if (auto error = parseIndices(text, anyCount, indices)) return error;
  if (indices.size() % n != 0) return notMultiple(text, n, indices.size(), "whole number");
  out.resize(indices.size() / n);
  for (std::size_t i = 0; i < indices.size(); ++i) out[i / n][i % n] = indices[i];
  return std::nullopt;
}

template <class Item>
void append(std::string& text, const std::vector<Item>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ' ';
    append(text, values[i]);
  }
}

}  // namespace

template <class T>
std::string PlainTraits<T>::typeName() {
  return stroma::typeName(static_cast<const T*>(nullptr));
}

template <class T>
std::optional<ParseError> PlainTraits<T>::parse(std::string_view text, const ValueContext& context,
                                                T& out) {
  return parseText(text, context, out);
}

template <class T>
std::string PlainTraits<T>::print(const T& value) {
  std::string text;
  append(text, value);
  return text;
}

template struct PlainTraits<bool>;
template struct PlainTraits<int>;
template struct PlainTraits<double>;
template struct PlainTraits<std::string>;
template struct PlainTraits<FilePath>;
template struct PlainTraits<Vec3>;
template struct PlainTraits<Quat>;
template struct PlainTraits<Box>;
template struct PlainTraits<Color>;
template struct PlainTraits<IndexList>;
template struct PlainTraits<std::array<Index, 2>>;
template struct PlainTraits<std::array<Index, 3>>;
template struct PlainTraits<std::vector<double>>;
template struct PlainTraits<std::vector<int>>;
template struct PlainTraits<std::vector<Vec3>>;
template struct PlainTraits<std::vector<std::string>>;
template struct PlainTraits<std::vector<Box>>;
template struct PlainTraits<std::vector<Edge>>;
template struct PlainTraits<std::vector<Triangle>>;
template struct PlainTraits<std::vector<Tetrahedron>>;
template struct PlainTraits<std::vector<Hexahedron>>;

std::optional<ParseError> parseChoice(std::string_view text,
                                      std::span<const std::string_view> names,
                                      std::size_t& chosen) {
  const std::string_view word = trimmed(text);
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) {
    chosen = static_cast<std::size_t>(found - names.begin());
    return std::nullopt;
  }
  return wholeError(
      text, word.empty() ? "value-missing" : "value-choice",
      "expected " + listChoices(names) + ", got " + (word.empty() ? "nothing" : quoted(word)),
      didYouMean(word, std::vector<std::string>(names.begin(), names.end())));
}

std::string listChoices(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) {
    if (!list.empty()) list += " | ";
    list += name;
  }
  return list;
}

}  // namespace stroma
