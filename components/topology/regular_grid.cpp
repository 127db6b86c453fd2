// SPDX-License-Identifier: Apache-2.0
#include "components/topology/regular_grid.h"

namespace stroma {
namespace {

using Counts = std::array<Index, 3>;

Index pointAt(const Counts& n, const Counts& at) { return at[0] + n[0] * (at[1] + n[1] * at[2]); }

void addHexahedra(const Counts& n, RegularGrid& grid) {
  for (Index k = 0; k + 1 < n[2]; ++k)
    for (Index j = 0; j + 1 < n[1]; ++j)
      for (Index i = 0; i + 1 < n[0]; ++i) {
        const auto p = [&](Index di, Index dj, Index dk) {
          return pointAt(n, {i + di, j + dj, k + dk});
        };
        grid.hexahedra.push_back({p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), p(0, 0, 1),
                                  p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)});
      }
}

// Both faces across `axis`; u, v complete it to a right-handed frame.
void addFaces(const Counts& n, int axis, RegularGrid& grid) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const bool far : {false, true})
    for (Index b = 0; b + 1 < n[v]; ++b)
      for (Index a = 0; a + 1 < n[u]; ++a) {
        const auto p = [&](Index da, Index db) {
          Counts at{};
          at[axis] = far ? n[axis] - 1 : 0;
          at[u] = a + da;
          at[v] = b + db;
          return pointAt(n, at);
        };
        const Quad q = far ? Quad{p(0, 0), p(1, 0), p(1, 1), p(0, 1)}
                           : Quad{p(0, 0), p(0, 1), p(1, 1), p(1, 0)};
        grid.quads.push_back(q);
        grid.triangles.push_back({q[0], q[1], q[2]});
        grid.triangles.push_back({q[0], q[2], q[3]});
      }
}

void addEdges(const Counts& n, RegularGrid& grid) {
  const Counts stride{1, n[0], n[0] * n[1]};
  for (std::size_t d = 0; d < 3; ++d)
    for (Index k = 0; k + (d == 2) < n[2]; ++k)
      for (Index j = 0; j + (d == 1) < n[1]; ++j)
        for (Index i = 0; i + (d == 0) < n[0]; ++i) {
          const Index from = pointAt(n, {i, j, k});
          grid.edges.push_back({from, from + stride[d]});
        }
}

void addVolumes(double cell, RegularGrid& grid) {
  grid.volumes.assign(grid.positions.size(), 0.0);
  for (const Hexahedron& hexahedron : grid.hexahedra)
    for (const Index i : hexahedron) grid.volumes[static_cast<std::size_t>(i)] += cell / 8;
}

}  // namespace

std::vector<Tetrahedron> splitCells(const Counts& n, std::span<const Hexahedron> cells,
                                    CellSplit split) {
  using Corners = std::array<std::size_t, 4>;
  static constexpr std::array<Corners, 6> six{
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  static constexpr std::array<Corners, 5> even{
      {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 7, 5, 6}, {0, 2, 7, 5}}};
  static constexpr std::array<Corners, 5> odd{
      {{1, 2, 3, 6}, {0, 1, 3, 4}, {1, 6, 4, 5}, {3, 4, 6, 7}, {1, 3, 4, 6}}};
  std::vector<Tetrahedron> tetrahedra;
  if (split == CellSplit::none) return tetrahedra;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const auto number = static_cast<Index>(cell);
    const Index i = number % (n[0] - 1), j = number / (n[0] - 1) % (n[1] - 1),
                k = number / (n[0] - 1) / (n[1] - 1);
    const std::span<const Corners> parts = split == CellSplit::six ? std::span<const Corners>(six)
                                           : (i + j + k) % 2 == 0  ? even
                                                                   : odd;
    const Hexahedron& h = cells[cell];
    for (const Corners& c : parts) tetrahedra.push_back({h[c[0]], h[c[1]], h[c[2]], h[c[3]]});
  }
  return tetrahedra;
}

RegularGrid makeRegularGrid(const Counts& n, const Vec3& min, const Vec3& max) {
  RegularGrid grid;
  if (n[0] < 1 || n[1] < 1 || n[2] < 1) {
    grid.problem = "a grid needs at least one point in every direction";
    return grid;
  }
  if (static_cast<std::int64_t>(n[0]) * n[1] > 100'000'000 / n[2]) {
    grid.problem = "the grid has more than 100 million points";
    return grid;
  }
  if (!min.allFinite() || !max.allFinite()) {
    grid.problem = "the grid's corners are not finite";
    return grid;
  }
  for (int d = 0; d < 3; ++d)
    if (n[d] > 1 && !(max[d] > min[d])) {
      grid.problem = std::string("the grid's max is not above its min in ") + "xyz"[d];
      return grid;
    }
  Vec3 step = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (n[d] > 1) step[d] = (max[d] - min[d]) / (n[d] - 1);
  for (Index k = 0; k < n[2]; ++k)
    for (Index j = 0; j < n[1]; ++j)
      for (Index i = 0; i < n[0]; ++i)
        grid.positions.emplace_back(min + Vec3(i, j, k).cwiseProduct(step));
  addEdges(n, grid);
  if (n[0] > 1 && n[1] > 1 && n[2] > 1) {
    addHexahedra(n, grid);
    for (const int axis : {0, 1, 2}) addFaces(n, axis, grid);
    addVolumes(step.prod(), grid);
  }
  return grid;
}

}  // namespace stroma
