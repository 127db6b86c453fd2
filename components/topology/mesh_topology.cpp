// SPDX-License-Identifier: Apache-2.0
#include "components/topology/mesh_topology.h"

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
  if (!failed() && !tetrahedronList->empty()) {
    volumes_ = lumpedVolumes(*position, *tetrahedronList);
  }
}

}  // namespace stroma
