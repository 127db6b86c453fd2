// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_bonds.h"

#include <algorithm>
#include <stdexcept>

#include "core/parallel.h"

namespace stroma {

MlsBonds::MlsBonds(ConstVec3Span X, const Neighbourhoods& n, const TransposedRows& transposed,
                   const Gradients& gradients, std::span<const double> volumes,
                   double controlStiffness)
    : positions_(X.begin(), X.end()),
      volumes_(volumes.begin(), volumes.end()),
      controlStiffness_(controlStiffness),
      deficient_(gradients.deficient),
      ownRows_(n.rows),
      backRows_(transposed.rows) {
  if (n.rows.size() != X.size() || volumes.size() != X.size() ||
      transposed.rows.size() != X.size() || gradients.values.size() != n.neighbours.size())
    throw std::invalid_argument("particles, neighbourhoods, gradients and volumes differ in size");
  for (const double v : volumes)
    if (!(v > 0)) throw std::invalid_argument("a particle volume is not positive");
  for (const Vec3& x : X) centroid_ += x / static_cast<double>(X.size());

  self_.resize(X.size());
  layOut(n, transposed);
  parallelFor(particleCount(), [&](Index i) {
    packOwn(i, n, gradients);
    if (hasControl()) packControl(i);
  });
  parallelFor(particleCount(), [&](Index i) { packBack(i, transposed); });
}

// The rows lie where those of the neighbourhoods do, with the same room to grow.
void MlsBonds::layOut(const Neighbourhoods& n, const TransposedRows& transposed) {
  own_.reserve(n.neighbours.capacity());
  own_.resize(n.neighbours.size());
  back_.reserve(transposed.links.capacity());
  back_.resize(transposed.links.size());
  if (!(controlStiffness_ > 0)) return;
  control_.reserve(n.neighbours.capacity());
  control_.resize(own_.size());
}

void MlsBonds::followRows(const Neighbourhoods& n, const TransposedRows& transposed,
                          const Gradients& gradients, std::span<const Index> own,
                          std::span<const Index> back) {
  layOut(n, transposed);
  deficient_ = gradients.deficient;
  for (const Index i : own) {
    ownRows_[i] = n.rows[i];
    const Vec4 self = self_[i].value;
    packOwn(i, n, gradients);
    self_[i].value[3] = self[3];
    if (hasControl()) packControl(i);
  }
  for (const Index j : back) {
    backRows_[j] = transposed.rows[j];
    packBack(j, transposed);
  }
}

void MlsBonds::packOwn(Index i, const Neighbourhoods& n, const Gradients& gradients) {
  const auto weights = n.weightsOf(i);
  double weightSum = 0;
  for (const double w : weights) weightSum += w;
  const auto found = std::ranges::lower_bound(deficient_, i, {}, &DeficientParticle::particle);
  const bool whole = found == deficient_.end() || found->particle != i;
  // F of a nearly flat row turns its plane, not what lies off it: control would take that for
  // strain
  const auto isSeen = [&](const Vec3& X) {
    const auto good = found->axes.leftCols(found->rank);
    return (X - good * (good.transpose() * X)).squaredNorm() < 1e-24 * X.squaredNorm();
  };
  Vec3 sum = Vec3::Zero();
  for (Index k = 0; k < ownRows_[i].size; ++k) {
    const Index slot = ownRows_[i].begin + k, j = n.neighbours[slot];
    const Vec3& g = gradients.values[slot];
    const Vec3 X = positions_[j] - positions_[i];
    const double length2 = X.squaredNorm();
    const bool controlled =
        controlStiffness_ > 0 && weightSum > 0 && length2 > 0 && (whole || isSeen(X));
    const double s =
        controlled ? controlStiffness_ * volumes_[i] * weights[k] / (weightSum * length2) : 0;
    own_[slot] = {{g.x(), g.y(), g.z()}, static_cast<float>(s), j};
    sum += g;
  }
  sum *= volumes_[i];
  self_[i].value = Vec4{sum.x(), sum.y(), sum.z(), 0};
}

void MlsBonds::packControl(Index i) {
  const Bond* bonds = own(i);
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (Index k = 0; k < ownRows_[i].size; ++k) {
    const Vec3 Xij = positions_[bonds[k].particle] - positions_[i];
    const double s = bonds[k].control;
    A += s * Xij * Xij.transpose();
    b += s * Xij;
  }
  for (Index k = 0; k < ownRows_[i].size; ++k) {
    const Vec3 Xij = positions_[bonds[k].particle] - positions_[i];
    const Vec3 g(bonds[k].g[0], bonds[k].g[1], bonds[k].g[2]);
    const double s = bonds[k].control;
    const Vec3 r = (s * Xij - A * g) / volumes_[i];
    control_[ownRows_[i].begin + k] = {{r.x(), r.y(), r.z()}, s - b.dot(g)};
  }
}

void MlsBonds::packBack(Index i, const TransposedRows& transposed) {
  double sum = 0;
  for (Index k = 0; k < backRows_[i].size; ++k) {
    const Index at = backRows_[i].begin + k;
    const BackLink& link = transposed.links[at];
    const Bond& bond = own_[link.slot];
    const double v = -volumes_[link.particle];
    back_[at] = {{v * bond.g[0], v * bond.g[1], v * bond.g[2]}, bond.control, link.particle};
    sum += bond.control;
  }
  self_[i].value[3] = sum;
}

}  // namespace stroma
