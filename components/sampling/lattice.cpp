// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/lattice.h"

#include <cmath>
#include <unordered_map>

#include "core/random.h"

namespace stroma {
namespace {

std::string whyNot(const LatticeOptions& o) {
  std::int64_t count = 1;
  for (int d = 0; d < 3; ++d) {
    if (o.cells[d] < 1) return "a lattice needs at least one particle along every axis";
    count *= o.cells[d];
    if (count > 100'000'000) return "the lattice has more than 100 million particles";
  }
  if (!o.min.allFinite() || !o.max.allFinite() || !(o.max.array() > o.min.array()).all())
    return "the lattice's max must lie above its min along every axis";
  if (!(o.jitter >= 0 && o.jitter < 0.5)) return "jitter must be at least 0 and below 0.5";
  return {};
}

}  // namespace

SurfaceMesh boxSurface(const std::array<Index, 3>& n, const Vec3& min, const Vec3& max) {
  SurfaceMesh mesh;
  const Vec3 step = (max - min).cwiseQuotient(Vec3(n[0], n[1], n[2]));
  std::unordered_map<std::int64_t, Index> number;
  const auto node = [&](const std::array<Index, 3>& at) {
    const std::int64_t key =
        at[0] + (n[0] + std::int64_t{1}) * (at[1] + (n[1] + std::int64_t{1}) * at[2]);
    const auto [entry, isNew] = number.try_emplace(key, static_cast<Index>(number.size()));
    if (isNew) mesh.positions.emplace_back(min + Vec3(at[0], at[1], at[2]).cwiseProduct(step));
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true})
      for (Index b = 0; b < n[(axis + 2) % 3]; ++b)
        for (Index a = 0; a < n[(axis + 1) % 3]; ++a) {
          const auto corner = [&](Index da, Index db) {
            std::array<Index, 3> at{};
            at[axis] = far ? n[axis] : 0;
            at[(axis + 1) % 3] = a + da;
            at[(axis + 2) % 3] = b + db;
            return node(at);
          };
          const Index p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          mesh.triangles.push_back(far ? Triangle{p, q, r} : Triangle{p, r, q});
          mesh.triangles.push_back(far ? Triangle{p, r, s} : Triangle{p, s, r});
        }
  return mesh;
}

LatticeSamples sampleLattice(const LatticeOptions& o) {
  LatticeSamples out;
  out.problem = whyNot(o);
  if (!out.problem.empty()) return out;
  const Vec3 cell = (o.max - o.min).cwiseQuotient(Vec3(o.cells[0], o.cells[1], o.cells[2]));
  UniformRandom random(o.seed);
  // named one by one: the order in which arguments are evaluated is not fixed
  const auto offset = [&] { return o.jitter > 0 ? o.jitter * (2 * random() - 1) : 0.0; };
  for (Index k = 0; k < o.cells[2]; ++k)
    for (Index j = 0; j < o.cells[1]; ++j)
      for (Index i = 0; i < o.cells[0]; ++i) {
        const double x = i + 0.5 + offset();
        const double y = j + 0.5 + offset();
        const double z = k + 0.5 + offset();
        out.positions.emplace_back(o.min + Vec3(x, y, z).cwiseProduct(cell));
      }
  out.volumes.assign(out.positions.size(), cell.prod());
  out.spacing = std::cbrt(cell.prod());
  out.surface = boxSurface(o.cells, o.min, o.max);
  return out;
}

}  // namespace stroma
