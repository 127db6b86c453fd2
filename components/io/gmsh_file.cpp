// SPDX-License-Identifier: Apache-2.0
#include "components/io/gmsh_file.h"

#include <cmath>
#include <optional>
#include <unordered_map>

#include "components/io/mesh_text.h"
#include "core/diagnostics.h"

namespace stroma {
namespace {

using Problem = std::optional<MeshProblem>;

template <class Number>
std::string takeNumber(std::string_view& line, Number& out) {
  const std::string_view word = takeWord(line);
  if (word.empty()) return "the line has too few numbers";
  if (!readNumber(word, out)) return stroma::quoted(word) + " is not a number";
  if (!std::isfinite(static_cast<double>(out))) return stroma::quoted(word) + " is not finite";
  return "";
}

bool hasVolume(const std::array<Vec3, 4>& x, double volume6) {
  double longest2 = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) longest2 = std::max(longest2, (x[a] - x[b]).squaredNorm());
  }
  return std::abs(volume6) > 1e-12 * longest2 * std::sqrt(longest2);
}

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  Problem read(MeshData& mesh) {
    if (auto problem = readFormat()) return problem;
    bool nodes = false, elements = false;
    while (!rest_.empty()) {
      std::string_view line = next();
      const std::string_view word = takeWord(line);
      if (word.empty()) continue;
      if (!word.starts_with('$')) return at("this line belongs to no section");
      Problem problem;
      if (word == "$Nodes") {
        nodes = true;
        problem = readEntries("Nodes", [&](std::string_view entry) { return node(entry, mesh); });
      } else if (word == "$Elements") {
        elements = true;
        problem =
            readEntries("Elements", [&](std::string_view entry) { return element(entry, mesh); });
      } else {
        problem = skipSection(word.substr(1));
      }
      if (problem) return problem;
    }
    if (nodes && elements) return std::nullopt;
    return MeshProblem{std::string("the file has no section ") + (nodes ? "$Elements" : "$Nodes") +
                       ": is it cut short?"};
  }

 private:
  std::string_view next() {
    ++line_;
    return takeLine(rest_);
  }
  [[nodiscard]] MeshProblem at(std::string message) const { return {std::move(message), line_}; }

  Problem readFormat() {
    std::string_view line = next();
    if (takeWord(line) != "$MeshFormat") {
      return at("this is no Gmsh file: it does not begin with $MeshFormat");
    }
    line = next();
    const std::string_view version = takeWord(line), binary = takeWord(line);
    if (!version.starts_with("2.") && version != "2") {
      return at("is of Gmsh's format " + stroma::quoted(version) +
                "; only format 2 is read: save it as \"Version 2 ASCII\"");
    }
    if (binary != "0") return at("is a binary file; only ASCII is read");
    line = next();
    if (takeWord(line) != "$EndMeshFormat") return at("expected $EndMeshFormat");
    return std::nullopt;
  }

  template <class Entry>
  Problem readEntries(const std::string& section, Entry&& entry) {
    std::int64_t count = 0;
    std::string_view line = next();
    const std::string problem = takeNumber(line, count);
    if (!problem.empty() || count < 0) return at("expected the number of entries of $" + section);
    for (std::int64_t k = 0; k < count; ++k) {
      if (rest_.empty() || rest_.starts_with('$')) {
        ++line_;
        return at("$" + section + " ends after " + std::to_string(k) + " of " +
                  std::to_string(count) + " entries: is the file cut short?");
      }
      const std::string wrong = entry(next());
      if (!wrong.empty()) return at(wrong);
    }
    line = next();
    if (takeWord(line) != "$End" + section) {
      return at("expected $End" + section + " after " + std::to_string(count) + " entries");
    }
    return std::nullopt;
  }

  Problem skipSection(std::string_view name) {
    const int begin = line_;
    while (!rest_.empty()) {
      std::string_view line = next();
      const std::string_view word = takeWord(line);
      if (word.starts_with("$End") && word.substr(4) == name) return std::nullopt;
    }
    return MeshProblem{"section " + stroma::quoted(name) + " has no end: is the file cut short?",
                       begin};
  }

  std::string node(std::string_view line, MeshData& mesh) {
    std::int64_t number = 0;
    std::string problem = takeNumber(line, number);
    Vec3 x;
    for (double& coordinate : x) {
      if (problem.empty()) problem = takeNumber(line, coordinate);
    }
    if (!problem.empty()) return problem;
    if (!takeWord(line).empty()) return "the line has too many numbers";
    const bool isNew = points_.emplace(number, static_cast<Index>(mesh.positions.size())).second;
    if (!isNew) return "node " + std::to_string(number) + " occurs twice";
    mesh.positions.push_back(x);
    return "";
  }

  std::string element(std::string_view line, MeshData& mesh) {
    constexpr std::int64_t lineKind = 1, triangleKind = 2, tetrahedronKind = 4, pointKind = 15;
    std::int64_t number = 0, kind = 0, tags = 0, tag = 0;
    std::string problem = takeNumber(line, number);
    if (problem.empty()) problem = takeNumber(line, kind);
    if (problem.empty()) problem = takeNumber(line, tags);
    for (; problem.empty() && tags > 0; --tags) problem = takeNumber(line, tag);
    if (!problem.empty()) return problem;
    switch (kind) {
      case pointKind:
      case lineKind:
        return "";
      case triangleKind: {
        Triangle t{};
        problem = corners(number, line, t);
        if (problem.empty()) mesh.triangles.push_back(t);
        return problem;
      }
      case tetrahedronKind: {
        Tetrahedron t{};
        problem = corners(number, line, t);
        if (problem.empty()) problem = addTetrahedron(number, t, mesh);
        return problem;
      }
      default:
        return "element " + std::to_string(number) + " is of kind " + std::to_string(kind) +
               "; only triangles (2) and tetrahedra (4) are read";
    }
  }

  template <std::size_t N>
  std::string corners(std::int64_t number, std::string_view& line,
                      std::array<Index, N>& element) const {
    for (Index& corner : element) {
      std::int64_t node = 0;
      std::string problem = takeNumber(line, node);
      if (!problem.empty()) return problem;
      const auto known = points_.find(node);
      if (known == points_.end()) {
        return "element " + std::to_string(number) + " names node " + std::to_string(node) +
               ", which the file does not have";
      }
      corner = known->second;
    }
    return takeWord(line).empty() ? "" : "the line has too many numbers";
  }

  static std::string addTetrahedron(std::int64_t number, Tetrahedron t, MeshData& mesh) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = mesh.positions[static_cast<std::size_t>(t[k])];
    const double volume6 = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
    if (!hasVolume(x, volume6)) {
      return "tetrahedron " + std::to_string(number) + " has no volume";
    }
    if (volume6 < 0) std::swap(t[2], t[3]);
    mesh.tetrahedra.push_back(t);
    return "";
  }

  std::string_view rest_;
  int line_ = 0;
  std::unordered_map<std::int64_t, Index> points_;  // by the file's numbers
};

}  // namespace

MeshData parseGmsh(std::string_view text) {
  MeshData mesh;
  if (auto problem = Reader(text).read(mesh)) mesh.problems.push_back(std::move(*problem));
  return mesh;
}

}  // namespace stroma
