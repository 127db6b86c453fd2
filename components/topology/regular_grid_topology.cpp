// SPDX-License-Identifier: Apache-2.0
#include "components/topology/regular_grid_topology.h"

namespace stroma {

void RegularGridTopology::bind() {
  std::array<Index, 3> counts = n;
  Vec3 low = min, high = max;
  const std::array each{&nx, &ny, &nz};
  const std::array lows{&xmin, &ymin, &zmin}, highs{&xmax, &ymax, &zmax};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto row = static_cast<Eigen::Index>(d);
    if (each[d]->isSet()) counts[d] = *each[d];
    if (lows[d]->isSet()) low[row] = *lows[d];
    if (highs[d]->isSet()) high[row] = *highs[d];
  }
  if (cellWidth.isSet()) {
    if (p0.isSet()) low = p0;
    high = low + *cellWidth * Vec3(counts[0] - 1, counts[1] - 1, counts[2] - 1);
  }
  RegularGrid grid = makeRegularGrid(counts, low, high);
  if (!grid.problem.empty()) {
    error("grid", grid.problem);
    return;
  }
  tetrahedronList.set(splitCells(counts, grid.hexahedra, createTetrahedra));
  position.set(std::move(grid.positions));
  edgeList.set(std::move(grid.edges));
  hexahedronList.set(std::move(grid.hexahedra));
  quadList.set(std::move(grid.quads));
  triangleList.set(std::move(grid.triangles));
  volume.set(std::move(grid.volumes));
}

}  // namespace stroma
