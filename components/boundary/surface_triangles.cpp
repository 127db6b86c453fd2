// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/surface_triangles.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/sorted_ids.h"

namespace stroma {
namespace {

// An id that the list has more than once, -1 if there is none. Negative ones do not count.
Index repeated(std::vector<Index> ids) {
  std::ranges::sort(ids);
  for (std::size_t k = 1; k < ids.size(); ++k)
    if (ids[k] >= 0 && ids[k] == ids[k - 1]) return ids[k];
  return -1;
}

}  // namespace

bool SurfaceTriangles::select(Component& component, const MechanicalState& state,
                              const Topology* topology,
                              const Attribute<std::vector<Triangle>>& given,
                              const Attribute<IndexList>& subset) {
  state_ = &state;
  topology_ = topology;
  if (given.isSet()) {
    selected_ = given;
  } else if (topology) {
    selected_.assign(topology->triangles().begin(), topology->triangles().end());
  }
  const auto total = static_cast<Index>(selected_.size());
  if (total == 0) {
    component.error("triangles-empty", "has no triangles to act on",
                    "give 'triangles', or a topology with triangles to the node");
    return false;
  }
  findSlots(given.isSet());
  if (subset.isSet()) {
    std::vector<Triangle> chosen;
    std::vector<Index> slots;
    for (const Index t : subset->indices) {
      if (t < 0 || t >= total) {
        component.error(
            subset, "index-range",
            "names triangle " + std::to_string(t) + ", but there are " + std::to_string(total),
            "triangles are counted from 0 to " + std::to_string(total - 1));
        return false;
      }
      chosen.push_back(selected_[static_cast<std::size_t>(t)]);
      slots.push_back(slots_[static_cast<std::size_t>(t)]);
    }
    selected_ = std::move(chosen);
    slots_ = std::move(slots);
    if (selected_.empty()) component.warning("index-empty", "acts on no triangle");
  }
  for (const Triangle& triangle : selected_) {
    for (const Index node : triangle) {
      if (node >= 0 && node < state.size()) continue;
      component.error("index-range",
                      "a triangle has node " + std::to_string(node) + ", but '" + state.path() +
                          "' has " + std::to_string(state.size()) + " particles",
                      "the load acts on a state of surface nodes; is 'state' the right one?");
      return false;
    }
  }
  if (const Index twice = repeated(slots_); twice >= 0) {
    component.error(subset.isSet() ? static_cast<const AttributeBase&>(subset) : given,
                    "index-twice", "names triangle " + std::to_string(twice) + " more than once",
                    "its load would count as often");
    return false;
  }
  foreign_ = std::ranges::find(slots_, -1) != slots_.end();
  build();
  findRim();
  return true;
}

// The topology's numbers of triangles that were given are found by their nodes.
void SurfaceTriangles::findSlots(bool given) {
  slots_.assign(selected_.size(), -1);
  if (!given) return std::iota(slots_.begin(), slots_.end(), Index{0});
  if (!topology_) return;
  std::map<Triangle, Index> numbers;
  Index number = 0;
  for (const Triangle& t : topology_->triangles()) numbers.emplace(t, number++);
  for (std::size_t k = 0; k < selected_.size(); ++k) {
    const auto at = numbers.find(selected_[k]);
    if (at != numbers.end()) slots_[k] = at->second;
  }
}

void SurfaceTriangles::build() {
  links_.build(selected_, state_->size());
  nodes_.clear();
  placeOf_.assign(static_cast<std::size_t>(state_->size()), -1);
  for (Index node = 0; node < state_->size(); ++node) {
    if (!links_.hasCorner(node)) continue;
    placeOf_[static_cast<std::size_t>(node)] = static_cast<Index>(nodes_.size());
    nodes_.push_back(node);
  }
  loaded_.clear();
  if (topology_) loaded_.assign(topology_->triangles().size(), -1);
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    if (slots_[k] >= 0) loaded_[static_cast<std::size_t>(slots_[k])] = static_cast<Index>(k);
  }
}

bool SurfaceTriangles::follow(Component& component, const TopologyChange& change) {
  if (&change.nodes != state_) return false;
  const bool known = &change.surface == topology_;
  if ((!known || foreign_) && !warned_) {
    warned_ = true;
    component.warning("triangles-uncut",
                      "acts on triangles that '" + change.surface.path() +
                          "', which has been cut, does not have: they stay as they were",
                      "link that topology, and choose triangles of it");
  }
  if (!known) return false;
  cut_ = true;
  changed_.clear();
  const SurfaceEdit& edit = change.edit;
  placeOf_.resize(static_cast<std::size_t>(state_->size()), -1);
  loaded_.resize(static_cast<std::size_t>(edit.firstNewTriangle) + edit.appended.size(), -1);
  for (const ChangedTriangle& t : edit.changed) {
    const Index own = loaded_[static_cast<std::size_t>(t.slot)];
    if (own >= 0) this->change(own, t.nodes);
  }
  for (std::size_t k = 0; k < edit.appended.size(); ++k) {
    if (!joins(edit, edit.appended[k])) continue;
    loaded_[static_cast<std::size_t>(edit.firstNewTriangle) + k] = count();
    this->change(count(), edit.appended[k].nodes);
  }
  sortUnique(changed_);
  return !changed_.empty();
}

// Whether it is a piece of a loaded triangle. Its parent may be a piece of the same change.
bool SurfaceTriangles::joins(const SurfaceEdit& edit, const AppendedTriangle& triangle) const {
  const AppendedTriangle* piece = &triangle;
  while (!piece->wall && piece->parent >= edit.firstNewTriangle) {
    piece = &edit.appended[static_cast<std::size_t>(piece->parent - edit.firstNewTriangle)];
  }
  return !piece->wall && piece->parent >= 0 &&
         loaded_[static_cast<std::size_t>(piece->parent)] >= 0;
}

void SurfaceTriangles::change(Index triangle, const Triangle& nodes) {
  const auto touch = [&](const Triangle& t) {
    for (const Index node : t) {
      Index& place = placeOf_[static_cast<std::size_t>(node)];
      if (place < 0) {
        place = static_cast<Index>(nodes_.size());
        nodes_.push_back(node);
      }
      changed_.push_back(place);
    }
  };
  if (triangle < count()) touch(links_.triangles()[static_cast<std::size_t>(triangle)]);
  touch(nodes);
  links_.change(triangle, nodes);
}

void SurfaceTriangles::check(const Component& component, TopologyCheck& check) const {
  if (&check.nodes != state_ || &check.surface != topology_) return;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) check.failures.push_back(component.path() + ": " + what);
  };
  const auto all = check.surface.triangles();
  bool same = loaded_.size() == all.size() || !cut_, gathered = true;
  for (std::size_t slot = 0; slot < loaded_.size() && same; ++slot) {
    const Index own = loaded_[slot];
    same = own < 0 || triangles()[static_cast<std::size_t>(own)] == all[slot];
  }
  for (const Triangle& t : triangles()) {
    for (const Index node : t) gathered = gathered && placeOf_[static_cast<std::size_t>(node)] >= 0;
  }
  require(same, "its triangles are not the surface's");
  require(gathered, "a node of its triangles carries no load");
}

bool SurfaceTriangles::restore() {
  if (!cut_) return false;
  cut_ = false;
  build();
  return true;
}

void SurfaceTriangles::findRim() {
  std::vector<Edge> edges;
  for (const Triangle& t : selected_) {
    for (std::size_t c = 0; c < 3; ++c) edges.push_back({t[c], t[(c + 1) % 3]});
  }
  std::ranges::sort(edges);
  rim_.clear();
  for (const Edge& e : edges) {
    if (std::ranges::binary_search(edges, Edge{e[1], e[0]})) continue;
    rim_.push_back(e[0]);
    rim_.push_back(e[1]);
  }
  std::ranges::sort(rim_);
  rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
}

}  // namespace stroma
