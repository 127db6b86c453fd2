// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_subdivision.h"

#include <algorithm>
#include <map>

namespace stroma {

void subdivide(MeshData& mesh) {
  std::map<Edge, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const Edge key = {std::min(a, b), std::max(a, b)};
    const auto [at, isNew] = middles.emplace(key, static_cast<Index>(mesh.positions.size()));
    if (isNew) {
      const auto halve = [&](std::vector<Vec3>& field) {
        if (field.empty()) return;
        const Vec3 mean =
            0.5 * (field[static_cast<std::size_t>(a)] + field[static_cast<std::size_t>(b)]);
        field.push_back(mean);
      };
      halve(mesh.positions);
      halve(mesh.texcoords);
      halve(mesh.normals);
      if (!mesh.normals.empty()) mesh.normals.back().normalize();
    }
    return at->second;
  };
  std::vector<Triangle> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Index a = middle(t[1], t[2]), b = middle(t[2], t[0]), c = middle(t[0], t[1]);
    finer.insert(finer.end(), {{t[0], c, b}, {c, t[1], a}, {b, a, t[2]}, {a, b, c}});
  }
  mesh.triangles = std::move(finer);
  for (MeshGroup& group : mesh.groups) {
    std::vector<Index> parts;
    for (const Index t : group.triangles) {
      for (Index k = 0; k < 4; ++k) parts.push_back(4 * t + k);
    }
    group.triangles = std::move(parts);
  }
  mesh.edges.clear();  // the file's own edges were those of the coarser triangles
}

}  // namespace stroma
