// SPDX-License-Identifier: Apache-2.0
// The data that the particle loops stream through, packed for them: for every particle its own
// bonds i -> j and the bonds j <- i of others that end in it, each with its gradient vector and its
// coefficient of zero-energy control in 32 bytes. Forces are gathered, never scattered.
//
// Zero-energy control adds the energy 1/2 sum_ij s_ij |e_ij|^2 of the part of the motion that F
// does not see, e_ij = x_ij - F_i X_ij, s_ij = stiffness V_i w_ij / (sum_k w_ik |X_ij|^2) (after
// Kugelstadt, Bender, Fernandez-Fernandez, Jeske, Loeschner, Longva 2021). It is quadratic with a
// constant Hessian, zero on affine motions, and keeps both momenta.
#pragma once

#include "components/mechanics/gradients.h"

namespace stroma {

// Four doubles in one register; the fourth lane carries nothing unless said otherwise.
using Vec4 = double __attribute__((vector_size(32)));

struct alignas(32) Bond {
  double g[3];
  float control;
  Index particle;
};

// Own bond of zero-energy control, premultiplied: the control's part of the stress is
// sum_j u_ij r^T and its force on i is sum_j sigma u_ij, u_ij = u_j - u_i.
struct alignas(32) ControlBond {
  double r[3];
  double sigma;
};

struct alignas(32) Vec4Cell {
  Vec4 value;
};

class MlsBonds {
 public:
  // volumes in m^3, all positive; controlStiffness in Pa (alpha E, alpha about 0.3), 0 for none.
  // Throws std::invalid_argument on sizes that do not agree or a volume that is not positive.
  MlsBonds(ConstVec3Span positions, const Neighbourhoods& neighbourhoods,
           const TransposedRows& transposed, const Gradients& gradients,
           std::span<const double> volumes, double controlStiffness);

  // Packs some rows again, after their links or gradients have changed: own rows, and the particles
  // that a changed link ends in or ended in. Costs what these rows hold.
  void followRows(const Neighbourhoods& neighbourhoods, const TransposedRows& transposed,
                  const Gradients& gradients, std::span<const Index> own,
                  std::span<const Index> back);

  [[nodiscard]] Index particleCount() const { return static_cast<Index>(volumes_.size()); }
  [[nodiscard]] bool hasControl() const { return !control_.empty(); }
  [[nodiscard]] double volume(Index i) const { return volumes_[i]; }
  [[nodiscard]] const Vec3& reference(Index i) const { return positions_[i]; }
  [[nodiscard]] std::span<const DeficientParticle> deficient() const { return deficient_; }

  [[nodiscard]] const Row& ownRow(Index i) const { return ownRows_[i]; }
  [[nodiscard]] const Row& backRow(Index i) const { return backRows_[i]; }
  [[nodiscard]] const Bond* own(Index i) const { return own_.data() + ownRows_[i].begin; }
  // In these g is -V_j g_ji, j the bond's particle.
  [[nodiscard]] const Bond* back(Index i) const { return back_.data() + backRows_[i].begin; }
  [[nodiscard]] const ControlBond* control(Index i) const {
    return control_.data() + ownRows_[i].begin;
  }
  // V_i sum_j g_ij, and in the fourth lane the sum of the control coefficients of the back bonds.
  [[nodiscard]] Vec4 self(Index i) const { return self_[i].value; }
  // Reference position relative to the centroid, where differences of products lose least.
  [[nodiscard]] Vec3 centred(Index i) const { return positions_[i] - centroid_; }

 private:
  void layOut(const Neighbourhoods& n, const TransposedRows& transposed);
  void packOwn(Index i, const Neighbourhoods& n, const Gradients& gradients);
  void packControl(Index i);
  void packBack(Index i, const TransposedRows& transposed);

  std::vector<Vec3> positions_;
  Vec3 centroid_ = Vec3::Zero();
  std::vector<double> volumes_;
  double controlStiffness_;
  std::vector<DeficientParticle> deficient_;
  std::vector<Row> ownRows_, backRows_;
  std::vector<Bond> own_, back_;
  std::vector<ControlBond> control_;
  std::vector<Vec4Cell> self_;
};

}  // namespace stroma
