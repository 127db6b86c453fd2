// SPDX-License-Identifier: Apache-2.0
#include "components/mechanics/mls_bonds.h"

#include <stdexcept>

#include "core/parallel.h"

namespace stroma {

MlsBonds::MlsBonds(ConstVec3Span X, const Neighbourhoods& n, const TransposedRows& transposed,
                   const Gradients& gradients, std::span<const double> volumes,
                   double controlStiffness)
    : positions_(X.begin(), X.end()),
      volumes_(volumes.begin(), volumes.end()),
      deficient_(gradients.deficient),
      ownRows_(n.rows),
      backRows_(transposed.rows) {
  if (n.rows.size() != X.size() || volumes.size() != X.size() ||
      transposed.rows.size() != X.size() || gradients.values.size() != n.neighbours.size())
    throw std::invalid_argument("particles, neighbourhoods, gradients and volumes differ in size");
  for (const double v : volumes)
    if (!(v > 0)) throw std::invalid_argument("a particle volume is not positive");
  for (const Vec3& x : X) centroid_ += x / static_cast<double>(X.size());

  own_.resize(n.neighbours.size());
  back_.resize(transposed.links.size());
  self_.resize(X.size());
  if (controlStiffness > 0) control_.resize(own_.size());
  parallelFor(particleCount(), [&](Index i) {
    packOwn(i, n, gradients, controlStiffness);
    if (hasControl()) packControl(i);
  });
  parallelFor(particleCount(), [&](Index i) { packBack(i, transposed); });
}

void MlsBonds::packOwn(Index i, const Neighbourhoods& n, const Gradients& gradients,
                       double stiffness) {
  const auto weights = n.weightsOf(i);
  double weightSum = 0;
  for (const double w : weights) weightSum += w;
  Vec3 sum = Vec3::Zero();
  for (Index k = 0; k < ownRows_[i].size; ++k) {
    const Index slot = ownRows_[i].begin + k, j = n.neighbours[slot];
    const Vec3& g = gradients.values[slot];
    const double length2 = (positions_[j] - positions_[i]).squaredNorm();
    const double s = stiffness > 0 && weightSum > 0 && length2 > 0
                         ? stiffness * volumes_[i] * weights[k] / (weightSum * length2)
                         : 0;
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
