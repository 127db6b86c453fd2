// SPDX-License-Identifier: Apache-2.0
#include "components/collision/bvh_collision_model.h"

#include <algorithm>

#include "core/snapshot.h"
#include "core/sorted_ids.h"

namespace stroma {

bool BVHCollisionModel::checkTriangles() {
  if (topology->triangles().empty()) {
    error(topology, "triangles-empty", "'" + topology->path() + "' has no triangles",
          "collision needs a triangle surface");
    return false;
  }
  for (const Triangle& triangle : topology->triangles()) {
    for (const Index node : triangle) {
      if (node >= 0 && node < state().size()) continue;
      error("index-range",
            "a triangle has node " + std::to_string(node) + ", but '" + state().path() + "' has " +
                std::to_string(state().size()) + " particles",
            "the surface moves with a state of its own nodes; is 'state' the right one?");
      return false;
    }
  }
  return true;
}

void BVHCollisionModel::bind() {
  if (!checkTriangles()) return;
  build();
  measureEdges();
}

void BVHCollisionModel::build() {
  links_.build(topology->triangles(), state().size());
  tree_.build(links_.triangles(), state().rest());
  closed_ = links_.closed();
}

void BVHCollisionModel::measureEdges() {
  double sum = 0;
  for (const Triangle& t : links_.triangles()) {
    const Corners c = cornersOf(t, state().rest());
    sum += (c.b - c.a).norm() + (c.c - c.b).norm() + (c.a - c.c).norm();
  }
  meanEdge_ = sum / static_cast<double>(3 * links_.triangles().size());
}

void BVHCollisionModel::start() {
  now_.assign(state().x().begin(), state().x().end());
  before_ = now_;
  boundsStep_ = followStep_ = 0;
  pieces_.clear();
  cutOff_.clear();
}

const Bounds& BVHCollisionModel::bounds(std::uint64_t step) {
  if (boundsStep_ != step) {
    bounds_ = {};
    for (const Vec3& p : state().x()) bounds_.add(p);
    boundsStep_ = step;
  }
  return bounds_;
}

void BVHCollisionModel::follow(std::uint64_t step) {
  if (followStep_ == step) return;
  const bool continues = followStep_ != 0 && followStep_ + 1 == step;
  const ConstVec3Span x = state().x();
  before_.swap(now_);
  now_.assign(x.begin(), x.end());
  if (!continues) before_ = now_;
  pieces_.swap(cutOff_);
  cutOff_.clear();
  tree_.refit(links_.triangles(), before_, now_);
  followStep_ = step;
}

void BVHCollisionModel::topologyChanged(const TopologyChange& change) {
  const bool sameSurface = &change.surface == topology.get(), sameNodes = &change.nodes == &state();
  if (sameSurface != sameNodes && !warned()) {
    warning("collision-uncut",
            "has the " + std::string(sameSurface ? "triangles" : "nodes") +
                " of what was cut, but " + (sameSurface ? "other nodes" : "other triangles") +
                ": it stays whole",
            "'state' and 'topology' must be those of the surface that is cut");
  }
  if (!sameSurface || !sameNodes) return;
  cut_ = true;
  const SurfaceEdit& edit = change.edit;
  appendPositions(edit);
  const auto appended = [&](std::size_t k) {
    return edit.firstNewTriangle + static_cast<Index>(k);
  };
  for (const ChangedTriangle& t : edit.changed) this->change(t.slot, t.nodes);
  for (std::size_t k = 0; k < edit.appended.size(); ++k) {
    const AppendedTriangle& t = edit.appended[k];
    this->change(appended(k), t.nodes);
    if (!t.wall) cutOff_.push_back({t.parent, appended(k)});
  }
  // what was closed can only be open along what has changed
  for (const ChangedTriangle& t : edit.changed) closed_ = closed_ && links_.closedRound(t.slot);
  for (std::size_t k = 0; k < edit.appended.size(); ++k) {
    closed_ = closed_ && links_.closedRound(appended(k));
  }
}

// New nodes were where the surface was at the last follow(), so that it moves on without a gap.
void BVHCollisionModel::appendPositions(const SurfaceEdit& edit) {
  const auto was = [&](Index node) { return now_[static_cast<std::size_t>(node)]; };
  for (const NewSurfaceNode& node : edit.nodes) {
    Vec3 p;
    if (node.copyOf >= 0) {
      p = was(node.copyOf);
    } else if (node.parents[0] >= 0) {
      p = (1 - node.weight) * was(node.parents[0]) + node.weight * was(node.parents[1]);
    } else {
      p = state().x()[now_.size()];
    }
    now_.push_back(p);
  }
}

void BVHCollisionModel::change(Index triangle, const Triangle& nodes) {
  links_.change(triangle, nodes);
  tree_.change(triangle, nodes, now_);
}

void BVHCollisionModel::checkTopology(TopologyCheck& check) const {
  if (&check.surface != topology.get() || &check.nodes != &state()) return;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) check.failures.push_back(path() + ": " + what);
  };
  require(std::ranges::equal(triangles(), check.surface.triangles()),
          "its triangles are not the surface's");
  require(std::ssize(now_) == state().size(), "its positions are not one a node");
  require(followStep_ == 0 || tree_.holds(triangles(), now_),
          "a box of its tree does not hold what is in it");
  require(closed_ == links_.closed(), "whether it is closed is wrong");
}

void BVHCollisionModel::topologyRestored() {
  if (!cut_) return;
  cut_ = false;
  build();
  start();
}

NearestTriangle BVHCollisionModel::nearest(const Vec3& p, double reach) const {
  return tree_.nearest(p, reach, links_.triangles(), now_);
}

FirstCrossing BVHCollisionModel::firstEntry(const Vec3& p0, const Vec3& p1) const {
  return tree_.firstEntry(p0, p1, links_.triangles(), before_, now_);
}

NearestTriangle BVHCollisionModel::slide(const Vec3& p, Index from, const Vec3& facing) const {
  constexpr double turnedAway = -0.3;  // cosine: more than a rim's right angle
  const auto triangles = links_.triangles();
  NearestTriangle best{from, nearestOn(from, p)};
  while (true) {
    const Triangle& here = triangles[static_cast<std::size_t>(best.triangle)];
    NearestTriangle next = best;
    for (std::size_t c = 0; c < 3; ++c) {
      if (best.at.weights[static_cast<Eigen::Index>(c)] == 0) continue;
      // neighbours that have the nearest point: all at a node, one across an edge
      links_.forCorners(here[c], [&](Index t, Index) {
        if (t == best.triangle) return;
        const Triangle& nodes = triangles[static_cast<std::size_t>(t)];
        for (std::size_t k = 0; k < 3; ++k) {
          const bool touches = std::ranges::find(nodes, here[k]) != nodes.end();
          if (best.at.weights[static_cast<Eigen::Index>(k)] != 0 && !touches) return;
        }
        const TrianglePoint at = nearestOn(t, p);
        if (!(at.distance2 < next.at.distance2)) return;
        const Vec3 n = cornersOf(nodes, now_).areaNormal();
        if (n.dot(facing) > turnedAway * n.norm()) next = {t, at};
      });
    }
    if (next.triangle == best.triangle) return best;
    best = next;
  }
}

Index BVHCollisionModel::pieceNear(Index triangle, const Vec3& p) const {
  if (pieces_.empty()) return triangle;
  std::vector<Index> candidates{triangle};
  for (const Piece& piece : pieces_) {
    if (std::ranges::find(candidates, piece.of) == candidates.end()) continue;
    candidates.push_back(piece.triangle);
  }
  return *std::ranges::min_element(candidates, {},
                                   [&](Index t) { return nearestOn(t, p).distance2; });
}

void BVHCollisionModel::nodesInBall(const Vec3& centre, double radius, std::vector<Index>& nodes) {
  near_.clear();
  tree_.inBall(centre, radius, near_);
  nodes.clear();
  for (const Index t : near_) {
    for (const Index node : links_.triangles()[static_cast<std::size_t>(t)]) {
      if ((now_[static_cast<std::size_t>(node)] - centre).norm() <= radius) nodes.push_back(node);
    }
  }
  sortUnique(nodes);
}

Vec3 BVHCollisionModel::outward(Index triangle, const Vec3& weights) const {
  return links_.pseudonormal(triangle, weights, now_).normalized();
}

Index BVHCollisionModel::triangleAt(Index node) const {
  Index found = -1;
  links_.forCorners(node, [&](Index t, Index) { found = found < 0 ? t : found; });
  return found;
}

Vec3 BVHCollisionModel::outwardAtNode(Index node) const {
  const Index t = triangleAt(node);
  if (t < 0) return Vec3::Zero();
  const Triangle& nodes = triangles()[static_cast<std::size_t>(t)];
  Vec3 weights = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    if (nodes[c] == node) weights[static_cast<Eigen::Index>(c)] = 1;
  }
  return outward(t, weights);
}

// The tree is not written, but put round the positions again: its answers do not depend on how it
// came about.
void BVHCollisionModel::save(StateWriter& writer) const {
  writer.write("positions", ConstVec3Span(now_));
  writer.write("followStep", followStep_);
}

void BVHCollisionModel::restore(StateReader& reader) {
  boundsStep_ = 0;
  pieces_.clear();
  cutOff_.clear();
  now_.resize(reader.count<double>("positions") / 3);
  if (!reader.read("positions", Vec3Span(now_)) || !reader.read("followStep", followStep_)) {
    start();
  }
  before_ = now_;
  tree_.refit(links_.triangles(), now_, now_);
}

}  // namespace stroma
