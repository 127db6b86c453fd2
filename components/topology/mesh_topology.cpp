// SPDX-License-Identifier: Apache-2.0
#include "components/topology/mesh_topology.h"

#include <algorithm>
#include <functional>

#include "components/topology/element_check.h"

namespace stroma {

void MeshTopology::bind() {
  const auto points = static_cast<Index>(position->size());
  if (points == 0) {
    error("topology-empty", "has no points: give 'position' or src=\"@loader\"");
    return;
  }
  const auto check = [&]<std::size_t N>(const Attribute<std::vector<std::array<Index, N>>>& list) {
    const std::string problem = elementProblem(std::span(*list), points);
    if (!problem.empty()) error(list, "topology-index", problem);
  };
  check(edgeList);
  check(triangleList);
  check(quadList);
  check(tetrahedronList);
  check(hexahedronList);
  if (!texcoords->empty() && texcoords->size() != position->size()) {
    error(texcoords, "topology-texture",
          "has " + std::to_string(texcoords->size()) + " entries for " + std::to_string(points) +
              " points");
  }
  if (failed() || (tetrahedronList->empty() && hexahedronList->empty())) return;
  volumes_ = lumpedVolumes(*position, std::span<const Tetrahedron>(*tetrahedronList));
  const auto more = lumpedVolumes(*position, std::span<const Hexahedron>(*hexahedronList));
  std::ranges::transform(volumes_, more, volumes_.begin(), std::plus());
}

void MeshTopology::topologyChanged(const TopologyChange& change) {
  if (&change.surface != this) return;
  if (!cut_) {
    cutPositions_ = position;
    cutTriangles_ = triangleList;
    cutTexture_ = texcoords;
    cutWalls_.assign(cutTriangles_.size(), 0);
    cut_ = true;
  }
  for (const NewSurfaceNode& node : change.edit.nodes) {
    cutPositions_.push_back(node.rest);
    if (!cutTexture_.empty()) cutTexture_.push_back(textureOf(node));
  }
  for (const ChangedTriangle& triangle : change.edit.changed) {
    cutTriangles_[static_cast<std::size_t>(triangle.slot)] = triangle.nodes;
  }
  for (const AppendedTriangle& triangle : change.edit.appended) {
    cutTriangles_.push_back(triangle.nodes);
    cutWalls_.push_back(triangle.wall);
  }
  ++revision_;
}

Vec3 MeshTopology::textureOf(const NewSurfaceNode& node) const {
  const auto at = [&](Index i) { return cutTexture_[static_cast<std::size_t>(i)]; };
  if (node.copyOf >= 0) return at(node.copyOf);
  if (node.parents[0] < 0) return Vec3::Zero();
  return (1 - node.weight) * at(node.parents[0]) + node.weight * at(node.parents[1]);
}

void MeshTopology::topologyRestored() {
  cut_ = false;
  cutPositions_.clear();
  cutTriangles_.clear();
  cutTexture_.clear();
  cutWalls_.clear();
  ++revision_;
}

}  // namespace stroma
