// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cctype>
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

// What a facet consists of, a line each.
constexpr std::array<std::string_view, 7> facetLines{"facet",  "outer",   "vertex",  "vertex",
                                                     "vertex", "endloop", "endfacet"};

// What is wrong with "x y z". A normal may be anything: it is not used.
std::string vectorProblem(std::string_view rest, bool mustBeFinite) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = takeWord(rest);
    double number = 0;
    if (word.empty()) return "fewer than three coordinates";
    if (!readNumber(word, number)) return stroma::quoted(word) + " is not a number";
    if (mustBeFinite && !std::isfinite(number)) return stroma::quoted(word) + " is not finite";
  }
  return takeWord(rest).empty() ? "" : "more than three coordinates";
}

// What is wrong with what stands behind a word that is in its place.
std::string restProblem(std::string_view word, std::string_view rest) {
  if (word == "vertex") return vectorProblem(rest, true);
  if (word == "facet" && takeWord(rest) != "normal") return "'facet' is followed by 'normal'";
  if (word == "facet") return vectorProblem(rest, false);
  if (word == "outer" && takeWord(rest) != "loop") return "'outer' is followed by 'loop'";
  return takeWord(rest).empty() ? "" : "there is more behind " + stroma::quoted(word);
}

std::optional<MeshProblem> textProblem(std::string_view rest) {
  int line = 0;
  std::size_t place = 0, facets = 0;  // place: in facetLines
  bool inSolid = false;
  while (!rest.empty()) {
    std::string_view words = takeLine(rest);
    ++line;
    const std::string_view word = takeWord(words);
    if (word.empty()) continue;
    const std::string_view wanted = inSolid ? facetLines[place] : "solid";
    if (inSolid && place == 0 && word == "endsolid") {
      inSolid = false;
    } else if (word != wanted) {
      return MeshProblem{"expected " + stroma::quoted(wanted) + ", got " + stroma::quoted(word),
                         line};
    } else if (!inSolid) {
      inSolid = true;
    } else {
      const std::string problem = restProblem(word, words);
      if (!problem.empty()) return MeshProblem{problem, line};
      place = (place + 1) % facetLines.size();
      if (place == 0) ++facets;
    }
  }
  if (place > 0) return MeshProblem{"the file ends inside a facet: is it cut short?"};
  if (inSolid) return MeshProblem{"the file ends without 'endsolid': is it cut short?"};
  if (facets == 0) return MeshProblem{"the file has no triangles"};
  return std::nullopt;
}

bool isText(std::string_view bytes) {
  return std::ranges::all_of(bytes,
                             [](unsigned char c) { return c >= 32 || std::isspace(c) != 0; });
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
  if (isText(bytes) && takeWord(start, " \t\r\n") == "solid") return textProblem(bytes);
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
