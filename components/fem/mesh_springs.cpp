// SPDX-License-Identifier: Apache-2.0
#include "components/fem/mesh_springs.h"

#include "core/parallel.h"

namespace stroma {
namespace {

// Of no direction where two ends meet: such a spring does not push.
Vec3 directionOf(const Vec3& d, double length) { return length > 0 ? Vec3(d / length) : d; }

}  // namespace

MeshSprings::MeshSprings(Index particles, std::span<const Spring> springs, bool onlyPull)
    : begin_(static_cast<std::size_t>(particles) + 1, 0), onlyPull_(onlyPull) {
  for (const Spring& s : springs)
    for (const Index end : s.ends) ++begin_[static_cast<std::size_t>(end) + 1];
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i) begin_[i + 1] += begin_[i];
  links_.resize(2 * springs.size());
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const Spring& s : springs)
    for (const int end : {0, 1}) {
      auto& place = next[static_cast<std::size_t>(s.ends[end])];
      links_[static_cast<std::size_t>(place++)] = {s.ends[1 - end], s.stiffness, s.damping,
                                                   s.length};
    }
}

void MeshSprings::addForces(ConstVec3Span x, ConstVec3Span v, Vec3Span f) const {
  parallelFor(static_cast<Index>(x.size()), [&](Index i) {
    Vec3 sum = Vec3::Zero();
    for (const Link& link : row(i)) {
      const Vec3 d = x[link.other] - x[i];
      const double length = d.norm();
      if (!acts(link, length)) continue;
      const Vec3 n = directionOf(d, length);
      sum +=
          (link.stiffness * (length - link.length) + link.damping * n.dot(v[link.other] - v[i])) *
          n;
    }
    f[i] += sum;
  });
}

double MeshSprings::energy(ConstVec3Span x) const {
  return parallelSum(static_cast<Index>(x.size()), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i)
      for (const Link& link : row(i)) {
        const double length = (x[link.other] - x[i]).norm();
        // half of it at either end
        if (acts(link, length))
          sum += 0.25 * link.stiffness * (length - link.length) * (length - link.length);
      }
    return sum;
  });
}

void MeshSprings::prepareTangent(ConstVec3Span x, bool filtered) {
  tangents_.resize(links_.size());
  parallelFor(static_cast<Index>(x.size()), [&](Index i) {
    for (Index k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Link& link = links_[k];
      const Vec3 d = x[link.other] - x[i];
      const double length = d.norm();
      if (!acts(link, length)) {
        tangents_[k] = {Vec3::Zero(), 0, 0, 0};
        continue;
      }
      const double stretch = length > 0 ? 1 - link.length / length : 0;
      const double lateral = link.stiffness * (filtered ? std::max(stretch, 0.0) : stretch);
      tangents_[k] = {directionOf(d, length), lateral, link.stiffness - lateral, link.damping};
    }
  });
}

MeshSprings::Tangent MeshSprings::scaled(const Tangent& t, double stiffness, double damping) {
  return {t.n, stiffness * t.lateral, stiffness * t.axial + damping * t.damping, 0};
}

void MeshSprings::addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                                    Vec3Span df) const {
  parallelFor(static_cast<Index>(dx.size()), [&](Index i) {
    Vec3 sum = Vec3::Zero();
    for (Index k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Tangent t = scaled(tangents_[k], stiffness, damping);
      const Vec3 u = dx[links_[k].other] - dx[i];
      sum += t.lateral * u + t.axial * t.n.dot(u) * t.n;
    }
    df[i] += sum;
  });
}

void MeshSprings::addPattern(BlockPattern& pattern, Index offset) const {
  for (Index i = 0; i + 1 < static_cast<Index>(begin_.size()); ++i)
    for (const Link& link : row(i))
      if (link.other < i) pattern.add(offset + i, offset + link.other);
}

void MeshSprings::addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                             double damping) const {
  for (Index i = 0; i + 1 < static_cast<Index>(begin_.size()); ++i)
    for (Index k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Tangent t = scaled(tangents_[k], stiffness, damping);
      const Mat3 block = t.lateral * Mat3::Identity() + t.axial * t.n * t.n.transpose();
      matrix.add(offset + i, offset + i, -block);
      matrix.add(offset + i, offset + links_[k].other, block);
    }
}

}  // namespace stroma
