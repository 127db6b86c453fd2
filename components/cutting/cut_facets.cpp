// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_facets.h"

#include "components/cutting/exact_predicates.h"

namespace stroma {

CutFacets::CutFacets(double cell) : grid_(cell) {}

void CutFacets::add(std::span<const RestTriangle> facets) {
  for (const RestTriangle& t : facets) {
    const Box box{t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
    grid_.insert(count(), box.low, box.high);
    facets_.push_back(t);
    boxes_.push_back(box);
  }
}

void CutFacets::block(const Vec3& from, ConstVec3Span to, std::span<char> blocked) const {
  for (std::size_t k = 0; k < to.size(); ++k) blocked[k] = crosses(from, to[k]) ? 1 : 0;
}

bool CutFacets::crossesNew(const Vec3& a, const Vec3& b, Index mark) const {
  if (mark >= count()) return false;
  bool crossed = false;
  const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  grid_.query(low, high, [&](Index k) {
    if (crossed || k < mark) return;
    // boxes that only touch are kept: the tie rule decides about points on a facet
    const Box& box = boxes_[static_cast<std::size_t>(k)];
    if ((high.array() < box.low.array()).any() || (low.array() > box.high.array()).any()) return;
    const RestTriangle& t = facets_[static_cast<std::size_t>(k)];
    crossed = segmentCrossesTriangle(a, b, t[0], t[1], t[2]);
  });
  return crossed;
}

bool CutFacets::crossesBruteForce(const Vec3& a, const Vec3& b) const {
  for (const RestTriangle& t : facets_)
    if (segmentCrossesTriangle(a, b, t[0], t[1], t[2])) return true;
  return false;
}

}  // namespace stroma
