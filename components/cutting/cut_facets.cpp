// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_facets.h"

#include "components/cutting/exact_predicates.h"

namespace stroma {

CutFacets::CutFacets(double cell) : grid_(cell) {}

void CutFacets::add(std::span<const RestTriangle> facets) {
  for (const RestTriangle& t : facets) {
    grid_.insert(count(), t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]));
    facets_.push_back(t);
  }
}

bool CutFacets::crossesNew(const Vec3& a, const Vec3& b, Index mark) const {
  if (mark >= count()) return false;
  bool crossed = false;
  grid_.query(a.cwiseMin(b), a.cwiseMax(b), [&](Index k) {
    if (crossed || k < mark) return;
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
