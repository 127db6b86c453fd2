// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/tetrahedral_file.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace stroma {
namespace {

// A file may claim any count: memory is taken as entries are read.
constexpr std::size_t mostEntries = 50'000'000;

std::size_t readCount(std::istream& in, const char* what) {
  std::size_t count = 0;
  if (!(in >> count) || count > mostEntries)
    throw std::runtime_error(std::string("bad number of ") + what);
  return count;
}

void readNodes(std::istream& in, TetrahedralFile& mesh) {
  const std::size_t count = readCount(in, "nodes");
  for (std::size_t k = 1; k <= count; ++k) {
    std::size_t number = 0;
    Vec3 x;
    if (!(in >> number >> x[0] >> x[1] >> x[2]) || number != k || !x.allFinite())
      throw std::runtime_error("bad node " + std::to_string(k));
    mesh.points.push_back(x);
  }
}

template <std::size_t N>
void readCorners(std::istream& in, std::vector<std::array<Index, N>>& elements,
                 std::size_t number) {
  std::array<Index, N> corners;
  for (Index& v : corners) {
    if (!(in >> v) || v < 1) throw std::runtime_error("bad element " + std::to_string(number));
    --v;
  }
  elements.push_back(corners);
}

void readElements(std::istream& in, TetrahedralFile& mesh) {
  constexpr int triangle = 2, tetrahedron = 4, mostTags = 100;
  const std::size_t count = readCount(in, "elements");
  std::string line;
  std::getline(in, line);
  for (std::size_t k = 1; k <= count; ++k) {
    std::getline(in, line);
    std::istringstream words(line);
    int number = 0, kind = 0, tags = 0, tag = 0;
    if (!(words >> number >> kind >> tags) || tags < 0 || tags > mostTags)
      throw std::runtime_error("bad element " + std::to_string(k));
    for (; tags > 0; --tags) words >> tag;
    if (kind == triangle) readCorners(words, mesh.surface, k);
    if (kind == tetrahedron) readCorners(words, mesh.tetrahedra, k);
  }
}

template <std::size_t N>
void requireNodes(const std::vector<std::array<Index, N>>& elements, std::size_t nodes) {
  for (const auto& corners : elements)
    for (const Index v : corners)
      if (v < 0 || static_cast<std::size_t>(v) >= nodes)
        throw std::runtime_error("an element names node " + std::to_string(v + 1) + " of " +
                                 std::to_string(nodes));
}

}  // namespace

TetrahedralFile readTetrahedra(std::istream& in) {
  TetrahedralFile mesh;
  std::string word;
  if (!(in >> word) || word != "$MeshFormat" || !(in >> word) || word.substr(0, 2) != "2.")
    throw std::runtime_error("not a Gmsh 2 file");
  int binary = 0;
  if (!(in >> binary) || binary != 0) throw std::runtime_error("not an ASCII file");
  while (in >> word) {
    if (word == "$Nodes") readNodes(in, mesh);
    if (word == "$Elements") readElements(in, mesh);
  }
  requireNodes(mesh.surface, mesh.points.size());
  requireNodes(mesh.tetrahedra, mesh.points.size());
  if (mesh.tetrahedra.empty()) throw std::runtime_error("no tetrahedra");
  return mesh;
}

TetrahedralFile readTetrahedra(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  try {
    return readTetrahedra(in);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(file.string() + ": " + e.what());
  }
}

}  // namespace stroma
