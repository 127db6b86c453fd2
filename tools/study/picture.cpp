// SPDX-License-Identifier: Apache-2.0
#include "tools/study/picture.h"

#include <algorithm>
#include <cmath>

#include "core/interfaces/mesh.h"
#include "core/traverse.h"

namespace stroma::study {
namespace {

constexpr std::size_t mostPoints = 4000;

// The triangles of the topology beside a state, of the same points; empty where there are none.
std::span<const Triangle> trianglesOf(const MechanicalState& state) {
  for (const Topology* topology : collectHere<Topology>(state.node())) {
    if (static_cast<Index>(topology->positions().size()) == state.size() &&
        !topology->triangles().empty()) {
      return topology->triangles();
    }
  }
  return {};
}

struct Drawing {
  std::vector<Vec3> points;
  std::vector<double> lengths;  // of displacements
  std::vector<Triangle> triangles;

  // Every `stride`-th point; the triangles only when all points are there.
  void add(const MechanicalState& state, std::span<const Triangle> surface, std::size_t stride) {
    const auto first = static_cast<Index>(points.size());
    for (std::size_t i = 0; i < state.x().size(); i += stride) {
      points.push_back(state.x()[i]);
      lengths.push_back((state.x()[i] - state.rest()[i]).norm());
    }
    if (stride > 1) return;
    for (const Triangle& t : surface)
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
};

// Surfaces where the scene has any, else the independent states.
Drawing draw(Scene& scene) {
  std::vector<const MechanicalState*> states;
  std::size_t count = 0;
  for (const bool surfaces : {true, false}) {
    for (const auto& system : scene.systems()) {
      const auto among = system->states(), mapped = system->mappedStates();
      for (const auto* list : {&among, &mapped}) {
        for (const MechanicalState* state : *list) {
          if (surfaces == trianglesOf(*state).empty()) continue;
          if (!surfaces && list == &mapped) continue;
          states.push_back(state);
          count += state->x().size();
        }
      }
    }
    if (!states.empty()) break;
  }
  Drawing drawing;
  const std::size_t stride = (count + mostPoints - 1) / mostPoints;
  for (const MechanicalState* state : states) drawing.add(*state, trianglesOf(*state), stride);
  return drawing;
}

}  // namespace

Json pictureOf(Scene& scene) {
  const Drawing drawing = draw(scene);
  if (drawing.points.empty()) return nullptr;
  Vec3 low = drawing.points.front(), high = low;
  double largest = 0;
  for (std::size_t i = 0; i < drawing.points.size(); ++i) {
    low = low.cwiseMin(drawing.points[i]);
    high = high.cwiseMax(drawing.points[i]);
    largest = std::max(largest, drawing.lengths[i]);
  }
  const double side = (high - low).maxCoeff();
  Json points = Json::array(), colours = Json::array(), triangles = Json::array();
  for (const Vec3& p : drawing.points) {
    for (const double part : Vec3(p - low)) {
      points.push_back(side > 0 ? std::lround(1000 * part / side) : 0);
    }
  }
  for (const double length : drawing.lengths) {
    colours.push_back(largest > 0 ? std::lround(255 * length / largest) : 0);
  }
  for (const Triangle& t : drawing.triangles) {
    for (const Index corner : t) triangles.push_back(corner);
  }
  return {{"points", std::move(points)},
          {"colours", std::move(colours)},
          {"triangles", std::move(triangles)},
          {"largest", largest},
          {"side", side}};
}

}  // namespace stroma::study
