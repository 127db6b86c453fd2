// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_group_roi.h"

#include <algorithm>

#include "core/diagnostics.h"

namespace stroma {

void MeshGroupRoi::bind() {
  const auto all = loader->triangles();
  std::vector<bool> chosen(all.size(), false);
  for (const std::string& name : *group) {
    const auto found = std::ranges::find(loader->groups(), name, &MeshGroup::name);
    if (found == loader->groups().end()) {
      std::string list;
      for (const std::string& other : *loader->groupNames)
        list += (list.empty() ? "" : ", ") + other;
      error(group, "group-unknown",
            "names " + stroma::quoted(name) + ", which the mesh does not have",
            list.empty() ? "it has no groups" : "its groups: " + list);
      continue;
    }
    for (const Index t : found->triangles) chosen[static_cast<std::size_t>(t)] = true;
  }
  if (failed()) return;
  std::vector<bool> inside(loader->positions().size(), false), shared(inside);
  IndexList points, list;
  std::vector<Triangle> taken;
  for (std::size_t t = 0; t < all.size(); ++t) {
    for (const Index i : all[t]) (chosen[t] ? inside : shared)[static_cast<std::size_t>(i)] = true;
    if (!chosen[t]) continue;
    list.indices.push_back(static_cast<Index>(t));
    taken.push_back(all[t]);
  }
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] && !(strict && shared[i])) points.indices.push_back(static_cast<Index>(i));
  }
  indices.set(std::move(points));
  triangleIndices.set(std::move(list));
  triangles.set(std::move(taken));
}

}  // namespace stroma
