// SPDX-License-Identifier: Apache-2.0
#include "components/collision/triangle_tree.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/surface_links.h"

namespace stroma {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet in double precision");

using Node = btDbvtNode;

btVector3 toBullet(const Vec3& a) { return {a.x(), a.y(), a.z()}; }

btDbvtVolume boxOf(const Corners& t) {
  return btDbvtVolume::FromMM(toBullet(t.a.cwiseMin(t.b).cwiseMin(t.c)),
                              toBullet(t.a.cwiseMax(t.b).cwiseMax(t.c)));
}

double distance2(const btDbvtVolume& box, const Vec3& p) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double outside = std::max({box.Mins()[k] - p[k], 0.0, p[k] - box.Maxs()[k]});
    sum += outside * outside;
  }
  return sum;
}

// A segment and what of it is still of interest, for tests against boxes.
struct Segment {
  Vec3 from, along;
  [[nodiscard]] bool meets(const btDbvtVolume& box, double slack, double until) const {
    double enter = 0, leave = until;
    for (int k = 0; k < 3; ++k) {
      const double low = box.Mins()[k] - slack - from[k], high = box.Maxs()[k] + slack - from[k];
      if (along[k] == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      const double a = low / along[k], b = high / along[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
  }
};

void mergeUp(Node* node) { Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume); }

}  // namespace

struct TriangleTree::Impl {
  btDbvt tree;
  std::vector<Node*> leaves;  // of each triangle, null for those that are gone
  std::vector<Node*> inner;   // every node after its children; empty when the tree has changed

  void orderInner() {
    inner.clear();
    const auto visit = [&](auto&& self, Node* node) -> void {
      if (node->isleaf()) return;
      self(self, node->childs[0]);
      self(self, node->childs[1]);
      inner.push_back(node);
    };
    if (tree.m_root) visit(visit, tree.m_root);
  }

  // Depth first, the nearer child first where `key` (smaller is nearer) says so. `open` tells
  // whether a box may still hold something better.
  template <class Open, class Key, class Leaf>
  void descend(const Node* node, const Open& open, const Key& key, const Leaf& leaf) const {
    if (!open(node->volume)) return;
    if (node->isleaf()) return leaf(node->dataAsInt);
    const Node *a = node->childs[0], *b = node->childs[1];
    if (key(b->volume) < key(a->volume)) std::swap(a, b);
    descend(a, open, key, leaf);
    descend(b, open, key, leaf);
  }
};

TriangleTree::TriangleTree() : impl_(std::make_unique<Impl>()) {}
TriangleTree::~TriangleTree() = default;

void TriangleTree::build(std::span<const Triangle> triangles, ConstVec3Span x) {
  impl_->tree.clear();
  impl_->inner.clear();
  impl_->leaves.assign(triangles.size(), nullptr);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!isGone(triangles[t])) change(static_cast<Index>(t), triangles[t], x);
  }
  impl_->tree.optimizeTopDown();
}

void TriangleTree::change(Index triangle, const Triangle& nodes, ConstVec3Span x) {
  const auto t = static_cast<std::size_t>(triangle);
  if (t >= impl_->leaves.size()) impl_->leaves.resize(t + 1, nullptr);
  Node*& leaf = impl_->leaves[t];
  if (leaf && !isGone(nodes)) {
    // it is still about where it was: the tree stays, the boxes above follow
    leaf->volume = boxOf(cornersOf(nodes, x));
    for (Node* node = leaf->parent; node; node = node->parent) mergeUp(node);
    return;
  }
  impl_->inner.clear();
  if (leaf) {
    impl_->tree.remove(leaf);
    leaf = nullptr;
  } else if (!isGone(nodes)) {
    leaf = impl_->tree.insert(boxOf(cornersOf(nodes, x)), nullptr);
    leaf->dataAsInt = triangle;
  }
}

void TriangleTree::refit(std::span<const Triangle> triangles, ConstVec3Span before,
                         ConstVec3Span now) {
  const bool moves = before.data() != now.data();
  for (std::size_t t = 0; t < impl_->leaves.size(); ++t) {
    Node* leaf = impl_->leaves[t];
    if (!leaf) continue;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Index node : triangles[t]) {
      const auto n = static_cast<std::size_t>(node);
      low = low.cwiseMin(now[n]);
      high = high.cwiseMax(now[n]);
      if (!moves || n >= before.size()) continue;
      low = low.cwiseMin(before[n]);
      high = high.cwiseMax(before[n]);
    }
    leaf->volume = btDbvtVolume::FromMM(toBullet(low), toBullet(high));
  }
  if (impl_->inner.empty()) impl_->orderInner();
  for (Node* node : impl_->inner) mergeUp(node);
}

NearestTriangle TriangleTree::nearest(const Vec3& p, double reach,
                                      std::span<const Triangle> triangles, ConstVec3Span x) const {
  NearestTriangle best;
  best.at.distance2 = reach * reach;
  if (!impl_->tree.m_root) return best;
  // a box's distance is rounded otherwise than its triangle's: of triangles at the same distance
  // the first in order is found in a tree of any shape
  const double slack = 1e-14 * p.squaredNorm();
  impl_->descend(
      impl_->tree.m_root,
      [&](const btDbvtVolume& box) {
        return distance2(box, p) <= (1 + 1e-12) * best.at.distance2 + slack;
      },
      [&](const btDbvtVolume& box) { return distance2(box, p); },
      [&](Index t) {
        const TrianglePoint at =
            nearestOnTriangle(cornersOf(triangles[static_cast<std::size_t>(t)], x), p);
        const bool tie = at.distance2 == best.at.distance2;
        if (at.distance2 < best.at.distance2 || (tie && (best.triangle < 0 || t < best.triangle))) {
          best = {t, at};
        }
      });
  return best;
}

FirstCrossing TriangleTree::firstEntry(const Vec3& p0, const Vec3& p1,
                                       std::span<const Triangle> triangles, ConstVec3Span before,
                                       ConstVec3Span now) const {
  FirstCrossing best;
  best.at.time = 1;
  if (!impl_->tree.m_root) return best;
  const Segment path{p0, p1 - p0};
  const Vec3 size = (p1 - p0).cwiseAbs() + p0.cwiseAbs();
  const double slack = 1e-9 * size.maxCoeff();
  const auto cornersBefore = [&](const Triangle& t) {
    const auto at = [&](Index node) {
      const auto n = static_cast<std::size_t>(node);
      return n < before.size() ? before[n] : now[n];
    };
    return Corners{at(t[0]), at(t[1]), at(t[2])};
  };
  impl_->descend(
      impl_->tree.m_root,
      // the surface moves, too: a box is met at any time, so that only the whole path counts
      [&](const btDbvtVolume& box) { return path.meets(box, slack, 1); },
      [](const btDbvtVolume&) { return 0.0; },
      [&](Index t) {
        const Triangle& nodes = triangles[static_cast<std::size_t>(t)];
        const auto hit = stroma::firstEntry(p0, p1, cornersBefore(nodes), cornersOf(nodes, now));
        if (!hit) return;
        const bool tie = hit->time == best.at.time;
        if (hit->time < best.at.time || (tie && (best.triangle < 0 || t < best.triangle))) {
          best = {t, *hit};
        }
      });
  return best;
}

void TriangleTree::inBall(const Vec3& centre, double radius, std::vector<Index>& found) const {
  if (!impl_->tree.m_root) return;
  impl_->descend(
      impl_->tree.m_root,
      [&](const btDbvtVolume& box) { return distance2(box, centre) <= radius * radius; },
      [](const btDbvtVolume&) { return 0.0; }, [&](Index t) { found.push_back(t); });
}

Index TriangleTree::leafCount() const {
  return static_cast<Index>(std::ranges::count_if(impl_->leaves, [](Node* n) { return n; }));
}

bool TriangleTree::holds(std::span<const Triangle> triangles, ConstVec3Span x) const {
  Index seen = 0;
  bool good = true;
  const auto visit = [&](auto&& self, const Node* node) -> void {
    if (node->isleaf()) {
      ++seen;
      const btDbvtVolume box =
          boxOf(cornersOf(triangles[static_cast<std::size_t>(node->dataAsInt)], x));
      good = good && node->volume.Contain(box);
      return;
    }
    for (const Node* child : node->childs) {
      good = good && node->volume.Contain(child->volume);
      self(self, child);
    }
  };
  if (impl_->tree.m_root) visit(visit, impl_->tree.m_root);
  return good && seen == leafCount();
}

}  // namespace stroma
