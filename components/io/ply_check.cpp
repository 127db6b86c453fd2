// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "components/io/file_check.h"
#include "components/io/mesh_text.h"
#include "core/diagnostics.h"

namespace stroma {
namespace {

struct Type {
  std::string_view name;
  std::size_t size;
  bool isWhole;
};

constexpr std::array<Type, 16> types{{{"char", 1, true},
                                      {"uchar", 1, true},
                                      {"short", 2, true},
                                      {"ushort", 2, true},
                                      {"int", 4, true},
                                      {"uint", 4, true},
                                      {"float", 4, false},
                                      {"double", 8, false},
                                      {"int8", 1, true},
                                      {"uint8", 1, true},
                                      {"int16", 2, true},
                                      {"uint16", 2, true},
                                      {"int32", 4, true},
                                      {"uint32", 4, true},
                                      {"float32", 4, false},
                                      {"float64", 8, false}}};

const Type* typeNamed(std::string_view name) {
  const auto at = std::ranges::find(types, name, &Type::name);
  return at == types.end() ? nullptr : &*at;
}

struct Property {
  const Type* count;  // of a list, else null
  const Type* type;
};

struct Element {
  std::string name;
  std::uint32_t count;
  std::vector<Property> properties;
};

struct Header {
  bool isText = true, isBigEndian = false;
  std::vector<Element> elements;
};

bool readFormat(std::string_view rest, Header& header) {
  const std::string_view kind = takeWord(rest);
  header.isText = kind == "ascii";
  header.isBigEndian = kind == "binary_big_endian";
  return header.isText || header.isBigEndian || kind == "binary_little_endian";
}

bool readElement(std::string_view rest, Header& header) {
  Element element{std::string(takeWord(rest)), 0, {}};
  const bool good = readNumber(takeWord(rest), element.count) && takeWord(rest).empty();
  header.elements.push_back(std::move(element));
  return good;
}

bool readProperty(std::string_view rest, Header& header) {
  Property property{nullptr, nullptr};
  std::string_view word = takeWord(rest);
  if (word == "list") {
    property.count = typeNamed(takeWord(rest));
    if (!property.count || !property.count->isWhole) return false;
    word = takeWord(rest);
  }
  property.type = typeNamed(word);
  const bool good = property.type && !takeWord(rest).empty() && takeWord(rest).empty();
  if (!good || header.elements.empty()) return false;
  header.elements.back().properties.push_back(property);
  return true;
}

// Takes the header off; `lines` counts its lines.
std::optional<MeshProblem> takeHeader(std::string_view& rest, int& lines, Header& header) {
  while (!rest.empty()) {
    const bool ended = rest.find('\n') != rest.npos;
    std::string_view line = takeLine(rest);
    const std::string_view word = takeWord(line);
    bool good = ++lines == 1 ? word == "ply" : word == "comment" || word == "obj_info";
    if (lines == 2) good = word == "format";
    if (word == "format") good = good && readFormat(line, header);
    if (word == "element") good = readElement(line, header);
    if (word == "property") good = readProperty(line, header);
    if (word == "end_header" && ended) {
      for (const Element& element : header.elements) {
        if (!element.properties.empty()) continue;
        return MeshProblem{"element " + stroma::quoted(element.name) + " has no properties"};
      }
      return std::nullopt;
    }
    if (!good) return MeshProblem{"this line of the header is not understood", lines};
  }
  return MeshProblem{"the header has no end"};
}

MeshProblem cutShort(const Element& element, std::uint32_t read) {
  return {"the file ends after " + std::to_string(read) + " of " + std::to_string(element.count) +
          " elements " + stroma::quoted(element.name) + ": is it cut short?"};
}

// One number of a line, and where it is the length of a list, its value.
std::string takeTextNumber(std::string_view& line, std::uint32_t* length) {
  const std::string_view word = takeWord(line);
  if (word.empty()) return "the line has too few numbers";
  double number = 0;
  if (length ? readNumber(word, *length) : readNumber(word, number)) {
    return std::isfinite(number) ? "" : stroma::quoted(word) + " is not finite";
  }
  return stroma::quoted(word) + " is not a " + (length ? "length of a list" : "number");
}

std::string lineProblem(std::string_view line, const Element& element) {
  for (const Property& property : element.properties) {
    std::uint32_t count = 1;
    std::string problem;
    if (property.count) problem = takeTextNumber(line, &count);
    for (std::uint32_t i = 0; i < count && problem.empty(); ++i) {
      problem = takeTextNumber(line, nullptr);
    }
    if (!problem.empty()) return problem;
  }
  return takeWord(line).empty() ? "" : "the line has too many numbers";
}

std::optional<MeshProblem> textProblem(std::string_view rest, int line, const Header& header) {
  for (const Element& element : header.elements) {
    for (std::uint32_t i = 0; i < element.count; ++i) {
      if (rest.empty()) return cutShort(element, i);
      const std::string problem = lineProblem(takeLine(rest), element);
      ++line;
      if (!problem.empty()) return MeshProblem{problem, line};
    }
  }
  return std::nullopt;
}

// Whole number of up to four bytes; signs are of no concern for the lengths of lists.
std::uint64_t wholeNumber(std::string_view bytes, bool isBigEndian) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char byte = bytes[isBigEndian ? i : bytes.size() - 1 - i];
    number = number << 8 | static_cast<unsigned char>(byte);
  }
  return number;
}

bool skipBinary(std::string_view& rest, const Element& element, bool isBigEndian) {
  for (const Property& property : element.properties) {
    std::uint64_t count = 1;
    if (property.count) {
      const std::size_t size = property.count->size;
      if (rest.size() < size) return false;
      count = wholeNumber(rest.substr(0, size), isBigEndian);
      rest.remove_prefix(size);
    }
    if (rest.size() < count * property.type->size) return false;
    rest.remove_prefix(count * property.type->size);
  }
  return true;
}

}  // namespace

std::optional<MeshProblem> plyProblem(std::string_view bytes) {
  Header header;
  int lines = 0;
  if (auto problem = takeHeader(bytes, lines, header)) return problem;
  if (header.isText) return textProblem(bytes, lines, header);
  for (const Element& element : header.elements) {
    for (std::uint32_t i = 0; i < element.count; ++i) {
      if (!skipBinary(bytes, element, header.isBigEndian)) return cutShort(element, i);
    }
  }
  return std::nullopt;
}

}  // namespace stroma
