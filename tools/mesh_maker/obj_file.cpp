// SPDX-License-Identifier: Apache-2.0
#include "tools/mesh_maker/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>

namespace stroma::meshes {
namespace {

std::string fixed(double value, int digits) {
  std::array<char, 64> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits)
          .ptr;
  std::string result(text.data(), end);
  // no negative zero
  if (result.find_first_not_of("-0.") == std::string::npos && result.front() == '-')
    result.erase(0, 1);
  return result;
}

struct NodeBox {
  Vec3 low, high;
};

// The nodes' bounding box on the micrometre grid.
NodeBox boxOf(ConstVec3Span x, std::span<const Index> nodes) {
  constexpr double grid = 1e-6, margin = 5e-6;
  NodeBox box{x[nodes[0]], x[nodes[0]]};
  for (const Index v : nodes) {
    box.low = box.low.cwiseMin(x[v]);
    box.high = box.high.cwiseMax(x[v]);
  }
  for (int d = 0; d < 3; ++d) {
    box.low[d] = std::floor((box.low[d] - margin) / grid) * grid;
    box.high[d] = std::ceil((box.high[d] + margin) / grid) * grid;
  }
  return box;
}

bool hits(const NodeBox& box, const Vec3& p) {
  return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
}

}  // namespace

void writeObj(const GroupedMesh& mesh, std::ostream& out) {
  for (const std::string& line : mesh.comments) out << "# " << line << '\n';
  for (const Vec3& p : mesh.positions)
    out << "v " << fixed(p[0], 9) << ' ' << fixed(p[1], 9) << ' ' << fixed(p[2], 9) << '\n';
  for (const Group& group : mesh.groups) {
    out << "g " << group.name << '\n';
    for (const Triangle& t : group.triangles)
      out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
}

std::string boxesAround(std::span<const std::vector<Index>> chains, ConstVec3Span x) {
  std::vector<bool> wanted(x.size(), false);
  for (const std::vector<Index>& chain : chains)
    for (const Index v : chain) wanted[v] = true;
  const auto isClean = [&](const NodeBox& box) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!wanted[i] && hits(box, x[i])) return false;
    return true;
  };
  std::string text;
  for (const std::vector<Index>& chain : chains)
    for (std::size_t begin = 0, end = 0; begin < chain.size(); begin = end) {
      NodeBox box = boxOf(x, std::span(chain).subspan(begin, 1));
      for (end = begin + 1; end < chain.size(); ++end) {
        const NodeBox larger = boxOf(x, std::span(chain).subspan(begin, end + 1 - begin));
        if (!isClean(larger)) break;
        box = larger;
      }
      for (const Vec3& corner : {box.low, box.high})
        for (int d = 0; d < 3; ++d) {
          if (!text.empty()) text += ' ';
          text += fixed(corner[d], 6);
        }
    }
  return text;
}

}  // namespace stroma::meshes
