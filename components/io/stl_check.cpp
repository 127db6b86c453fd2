// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "components/io/file_check.h"
#include "components/io/mesh_text.h"
#include "core/diagnostics.h"

namespace stroma {
namespace {

constexpr std::size_t headerSize = 84, triangleSize = 50;

// What is wrong with "x y z" behind the word vertex.
std::string vertexProblem(std::string_view rest) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = takeWord(rest);
    double number = 0;
    if (word.empty()) return "the vertex has fewer than three coordinates";
    if (!readNumber(word, number)) return stroma::quoted(word) + " is not a number";
    if (!std::isfinite(number)) return "the vertex has a coordinate that is not finite";
  }
  return takeWord(rest).empty() ? "" : "the vertex has more than three coordinates";
}

std::optional<MeshProblem> textProblem(std::string_view rest) {
  int line = 0, vertices = 0;
  std::uint64_t facets = 0;
  bool inFacet = false, ended = false;
  while (!rest.empty()) {
    std::string_view words = takeLine(rest);
    ++line;
    std::string problem;
    const std::string_view word = takeWord(words);
    if (word == "solid") ended = false;
    if (word == "endsolid") ended = true;
    if (word == "facet") {
      if (inFacet) problem = "a facet begins inside another";
      inFacet = true;
      vertices = 0;
      ++facets;
    } else if (word == "endfacet") {
      if (!inFacet) problem = "a facet ends that has not begun";
      if (vertices != 3) problem = "the facet has " + std::to_string(vertices) + " vertices";
      inFacet = false;
    } else if (word == "vertex") {
      problem = inFacet ? vertexProblem(words) : "the vertex is outside of a facet";
      ++vertices;
    }
    if (!problem.empty()) return MeshProblem{problem, line};
  }
  if (inFacet) return MeshProblem{"the file ends inside a facet: is it cut short?"};
  if (!ended) return MeshProblem{"the file ends without 'endsolid': is it cut short?"};
  if (facets == 0) return MeshProblem{"the file has no triangles"};
  return std::nullopt;
}

bool isText(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](unsigned char c) { return c >= 32 || std::isspace(c); });
}

}  // namespace

std::optional<MeshProblem> stlProblem(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= headerSize) std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::uint64_t wanted = headerSize + triangleSize * std::uint64_t{count};
  if (bytes.size() >= headerSize && bytes.size() == wanted) {
    if (count == 0) return MeshProblem{"the file has no triangles"};
    return std::nullopt;
  }
  std::string_view start = bytes;
  if (takeWord(start, " \t\r\n") == "solid") return textProblem(bytes);
  if (bytes.size() < headerSize || isText(bytes)) {
    return MeshProblem{"this is no STL file: a text file begins with 'solid', a binary one has " +
                       std::to_string(headerSize) + " bytes and " + std::to_string(triangleSize) +
                       " more for each triangle"};
  }
  return MeshProblem{"a binary file of " + std::to_string(count) + " triangles has " +
                     std::to_string(wanted) + " bytes, this one " + std::to_string(bytes.size()) +
                     (bytes.size() < wanted ? ": is it cut short?" : "")};
}

}  // namespace stroma
