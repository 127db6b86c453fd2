// SPDX-License-Identifier: Apache-2.0
// Total-Lagrangian point-based elasticity: F_i from moving-least-squares gradients, the energy
// sum_i V_i psi(F_i) of any law of components/material, its exact negative gradient as force
//   f_j = -sum_i V_i P_i g_ij,  f_i = +V_i P_i sum_j g_ij,
// products with the stiffness, and its blocks; each with zero-energy control where the bonds carry
// it. (The force of Mueller et al. 2004; a force is the derivative of all energies that a particle
// takes part in, not of its own alone.) Momentum is kept to rounding for every law, angular
// momentum for every law that is blind to rotation.
//
// Two passes over the particles: stress from the own bonds, force from the bonds that end in a
// particle. Nothing is allocated after construction except by prepareTangent. Units: SI.
#pragma once

#include "components/material/closest_rotations.h"
#include "components/material/elastic_law.h"
#include "components/mechanics/mls_bonds.h"
#include "core/parallel.h"

namespace stroma {

template <class Material>
class MlsElasticity {
 public:
  // The bonds must outlive this object. Without control their zero-energy control is left out.
  MlsElasticity(const Material& material, const MlsBonds& bonds, bool control = true)
      : material_(material), bonds_(bonds), control_(control && bonds.hasControl()) {
    const auto count = static_cast<std::size_t>(bonds.particleCount());
    motion_.resize(count);
    stress_.resize(count);
    if (control_) residual_.resize(count);
  }

  [[nodiscard]] const Material& material() const { return material_; }
  void setMaterial(const Material& material) { material_ = material; }

  // Deformation gradients at positions x.
  void deformation(ConstVec3Span x, std::span<Mat3> F) {
    loadDisplacement(x);
    parallelFor(bonds_.particleCount(), [&](Index i) { F[i] = deformationOf(i); });
    for (const DeficientParticle& d : bonds_.deficient())
      F[d.particle] = completeGradient(d, F[d.particle]);
  }

  // The same of one particle; costs what its row holds.
  [[nodiscard]] Mat3 deformationAt(ConstVec3Span x, Index i) const {
    return completed(i, fittedAt(x, i));
  }
  // Cauchy stress P F^T / J of one particle; a collapsed particle has none.
  [[nodiscard]] Mat3 stressAt(ConstVec3Span x, Index i) const {
    return cauchyStress(deformationAt(x, i));
  }
  [[nodiscard]] Mat3 cauchyStress(const Mat3& F) const {
    const double J = F.determinant();
    return std::abs(J) > 1e-12 ? Mat3(material_.stress(F) * F.transpose() / J) : Mat3(Mat3::Zero());
  }

  [[nodiscard]] double energy(ConstVec3Span x);
  // The same of some particles; costs what their rows hold.
  [[nodiscard]] double energyOf(ConstVec3Span x, std::span<const Index> particles) const;

  // f += forces at positions x.
  void addForces(ConstVec3Span x, Vec3Span f) {
    loadDisplacement(x);
    if (control_)
      addMotionForces<true>(f);
    else
      addMotionForces<false>(f);
  }

  // Keeps the material's tangent at x for the products and blocks that follow.
  void prepareTangent(ConstVec3Span x, TangentKind kind = TangentKind::exact);

  // df += factor K dx, K = d2 energy / dx2 at the prepared state (so that d force = -K dx).
  void addStiffnessProduct(double factor, ConstVec3Span dx, Vec3Span df) {
    load(dx);
    if (control_)
      addMotionProduct<true>(factor, df);
    else
      addMotionProduct<false>(factor, df);
  }

  // Calls add(row particle, column particle, block) with every 3x3 contribution to K. Serial.
  template <class Add>
  void assembleStiffness(Add&& add) const;

 private:
  // Whether the law can be told the closest rotation.
  static constexpr bool usesRotation = requires(const Material& m, const Mat3& F) {
    m.stress(F, F);
  };

  struct alignas(32) Columns {
    Vec4 c[3];
  };
  // Motion of the affine fit, u = H X + offset, and the control's own force.
  struct alignas(32) Residual {
    Vec4 h[3], offset, own;
  };

  static Columns pack(const Mat3& A) {
    Columns out;
    for (int k = 0; k < 3; ++k) out.c[k] = Vec4{A(0, k), A(1, k), A(2, k), 0};
    return out;
  }
  static Mat3 unpack(const Vec4& c0, const Vec4& c1, const Vec4& c2) {
    Mat3 A;
    A << c0[0], c1[0], c2[0], c0[1], c1[1], c2[1], c0[2], c1[2], c2[2];
    return A;
  }

  [[gnu::always_inline]] Columns stressOf(const Columns& h) const {
    if constexpr (requires(Vec4 v) { material_.stressColumns(v, v, v, v, v, v); }) {
      Columns p;
      material_.stressColumns(h.c[0] + Vec4{1, 0, 0, 0}, h.c[1] + Vec4{0, 1, 0, 0},
                              h.c[2] + Vec4{0, 0, 1, 0}, p.c[0], p.c[1], p.c[2]);
      return p;
    } else {
      return pack(material_.stress(unpack(h.c[0], h.c[1], h.c[2]) + Mat3::Identity()));
    }
  }

  void loadDisplacement(ConstVec3Span x) {
    parallelFor(bonds_.particleCount(), [&](Index i) {
      const Vec3 u = x[i] - bonds_.reference(i);
      motion_[i].value = Vec4{u.x(), u.y(), u.z(), 0};
    });
  }
  void load(ConstVec3Span u) {
    parallelFor(bonds_.particleCount(), [&](Index i) {
      motion_[i].value = Vec4{u[i].x(), u[i].y(), u[i].z(), 0};
    });
  }

  // Even and odd bonds have sums of their own: one chain of additions would wait for itself.
  [[gnu::always_inline]] Columns gradientOf(Index i) const {
    Vec4 h0{}, h1{}, h2{}, k0{}, k1{}, k2{};
    const Vec4 ui = motion_[i].value;
    const Bond* bond = bonds_.own(i);
    const Bond* end = bond + bonds_.ownRow(i).size;
    for (; bond + 1 < end; bond += 2) {
      const Vec4 d = motion_[bond[0].particle].value - ui;
      const Vec4 e = motion_[bond[1].particle].value - ui;
      h0 += d * bond[0].g[0];
      h1 += d * bond[0].g[1];
      h2 += d * bond[0].g[2];
      k0 += e * bond[1].g[0];
      k1 += e * bond[1].g[1];
      k2 += e * bond[1].g[2];
    }
    if (bond != end) {
      const Vec4 d = motion_[bond->particle].value - ui;
      h0 += d * bond->g[0];
      h1 += d * bond->g[1];
      h2 += d * bond->g[2];
    }
    return {{h0 + k0, h1 + k1, h2 + k2}};
  }
  Mat3 deformationOf(Index i) const {
    const Columns h = gradientOf(i);
    return unpack(h.c[0], h.c[1], h.c[2]) + Mat3::Identity();
  }

  template <bool Control>
  void addMotionForces(Vec3Span f);
  template <bool Control>
  void addMotionProduct(double factor, Vec3Span df);
  // stress_[i] and residual_[i] from the motion; response maps its gradient to a stress.
  template <bool Control, class Response>
  [[gnu::always_inline]] void gatherStress(Index i, Response&& response);
  // The same for up to eight particles from `first` on, whose rotations are found at once.
  template <bool Control>
  void gatherStresses(Index first, int count);
  // Force on i from the stresses of the particles that have it as a neighbour, and its own.
  template <bool Control>
  [[gnu::always_inline]] Vec4 gatherForce(Index i) const;

  Mat3 tangentStress(Index i, const Mat3& dF) const {
    return filtered_ ? material_.dStress(filteredTangents_[i], dF)
                     : material_.dStress(tangents_[i], dF);
  }
  // F as the bonds see it, and what a particle makes of it that they do not hold in all directions.
  [[nodiscard]] Mat3 fittedAt(ConstVec3Span x, Index i) const;
  [[nodiscard]] Mat3 completed(Index i, const Mat3& F) const;
  // At positions x, where H = F - I.
  [[nodiscard]] double controlEnergy(ConstVec3Span x, Index i, const Mat3& H) const;
  template <class Add>
  void assembleControl(Index i, std::span<const Index> ids, std::span<const Vec3> g,
                       Add&& add) const;

  Material material_;
  const MlsBonds& bonds_;
  bool control_;
  bool filtered_ = false;
  std::vector<Vec4Cell> motion_;
  std::vector<Columns> stress_;
  std::vector<Residual> residual_;
  std::vector<typename Material::Tangent> tangents_;
  std::vector<typename Material::FilteredTangent> filteredTangents_;
  std::vector<Mat3> deficientF_;  // completed, at the prepared state
};

template <class Material>
template <bool Control, class Response>
inline void MlsElasticity<Material>::gatherStress(Index i, Response&& response) {
  if constexpr (!Control) {
    const Columns h = gradientOf(i);
    stress_[i] = response(h);
  } else {
    Vec4 h0{}, h1{}, h2{}, q0{}, q1{}, q2{}, own{};
    const Vec4 ui = motion_[i].value;
    const Bond* bond = bonds_.own(i);
    const ControlBond* control = bonds_.control(i);
    for (const Bond* end = bond + bonds_.ownRow(i).size; bond != end; ++bond, ++control) {
      const Vec4 d = motion_[bond->particle].value - ui;
      h0 += d * bond->g[0];
      h1 += d * bond->g[1];
      h2 += d * bond->g[2];
      q0 += d * control->r[0];
      q1 += d * control->r[1];
      q2 += d * control->r[2];
      own += d * control->sigma;
    }
    Columns s = response(Columns{{h0, h1, h2}});
    s.c[0] -= q0;
    s.c[1] -= q1;
    s.c[2] -= q2;
    stress_[i] = s;
    const Vec3 X = bonds_.centred(i);
    residual_[i] = {{h0, h1, h2}, ui - h0 * X.x() - h1 * X.y() - h2 * X.z(), own};
  }
}

template <class Material>
template <bool Control>
inline Vec4 MlsElasticity<Material>::gatherForce(Index i) const {
  const Vec4 self = bonds_.self(i);
  const Columns& p = stress_[i];
  Vec4 force = p.c[0] * self[0] + p.c[1] * self[1] + p.c[2] * self[2];
  const Bond* bond = bonds_.back(i);
  const Bond* end = bond + bonds_.backRow(i).size;
  if constexpr (!Control) {
    const auto pull = [this](const Bond& b) {
      const Columns& s = stress_[b.particle];
      return s.c[0] * b.g[0] + s.c[1] * b.g[1] + s.c[2] * b.g[2];
    };
    Vec4 odd{};
    for (; bond + 1 < end; bond += 2) {
      force += pull(bond[0]);
      odd += pull(bond[1]);
    }
    if (bond != end) force += pull(*bond);
    force += odd;
  } else {
    Vec4 h0{}, h1{}, h2{}, offset{};
    for (; bond != end; ++bond) {
      const Columns& s = stress_[bond->particle];
      const Residual& r = residual_[bond->particle];
      const double weight = bond->control;
      force += s.c[0] * bond->g[0] + s.c[1] * bond->g[1] + s.c[2] * bond->g[2];
      h0 += r.h[0] * weight;
      h1 += r.h[1] * weight;
      h2 += r.h[2] * weight;
      offset += r.offset * weight;
    }
    const Vec3 X = bonds_.centred(i);
    force += residual_[i].own - motion_[i].value * self[3];
    force += h0 * X.x() + h1 * X.y() + h2 * X.z() + offset;
  }
  return force;
}

template <class Material>
template <bool Control>
void MlsElasticity<Material>::gatherStresses(Index first, int count) {
  MatrixBatch F, R;
  for (int k = 0; k < count; ++k) {
    gatherStress<Control>(first + k, [&](const Columns& h) {
      F[k] = unpack(h.c[0], h.c[1], h.c[2]) + Mat3::Identity();
      return Columns{};
    });
  }
  std::fill(F.begin() + count, F.end(), Mat3::Identity());
  closestRotations(F, R);
  for (int k = 0; k < count; ++k) {
    const Columns p = pack(material_.stress(F[k], R[k]));
    for (int c = 0; c < 3; ++c) stress_[first + k].c[c] += p.c[c];
  }
}

template <class Material>
template <bool Control>
void MlsElasticity<Material>::addMotionForces(Vec3Span f) {
  if constexpr (usesRotation) {
    static_assert(defaultChunk % rotationBatch == 0, "a batch is in one chunk");
    parallelChunks(bonds_.particleCount(), defaultChunk, [&](Index begin, Index end) {
      for (Index i = begin; i < end; i += rotationBatch)
        gatherStresses<Control>(i, std::min(rotationBatch, end - i));
    });
  } else {
    const auto law = [this](const Columns& h) { return stressOf(h); };
    parallelFor(bonds_.particleCount(), [&](Index i) { gatherStress<Control>(i, law); });
  }
  for (const DeficientParticle& d : bonds_.deficient())
    gatherStress<Control>(d.particle, [&](const Columns& h) {
      const Mat3 F = unpack(h.c[0], h.c[1], h.c[2]) + Mat3::Identity();
      return pack(material_.stress(completeGradient(d, F)));
    });
  parallelFor(bonds_.particleCount(), [&](Index i) {
    const Vec4 force = gatherForce<Control>(i);
    f[i] += Vec3(force[0], force[1], force[2]);
  });
}

template <class Material>
template <bool Control>
void MlsElasticity<Material>::addMotionProduct(double factor, Vec3Span df) {
  parallelFor(bonds_.particleCount(), [&](Index i) {
    gatherStress<Control>(i, [&](const Columns& h) {
      return pack(tangentStress(i, unpack(h.c[0], h.c[1], h.c[2])));
    });
  });
  for (std::size_t k = 0; k < bonds_.deficient().size(); ++k) {
    const DeficientParticle& d = bonds_.deficient()[k];
    gatherStress<Control>(d.particle, [&](const Columns& h) {
      const Mat3 dF = unpack(h.c[0], h.c[1], h.c[2]);
      return pack(tangentStress(d.particle, completeDerivative(d, deficientF_[k], dF)));
    });
  }
  parallelFor(bonds_.particleCount(), [&](Index i) {
    const Vec4 force = gatherForce<Control>(i);
    df[i] -= factor * Vec3(force[0], force[1], force[2]);
  });
}

template <class Material>
Mat3 MlsElasticity<Material>::fittedAt(ConstVec3Span x, Index i) const {
  const Vec3 ui = x[i] - bonds_.reference(i);
  Mat3 F = Mat3::Identity();
  const Bond* bond = bonds_.own(i);
  for (const Bond* end = bond + bonds_.ownRow(i).size; bond != end; ++bond) {
    const Vec3 u = x[bond->particle] - bonds_.reference(bond->particle) - ui;
    F += u * Vec3(bond->g[0], bond->g[1], bond->g[2]).transpose();
  }
  return F;
}

template <class Material>
Mat3 MlsElasticity<Material>::completed(Index i, const Mat3& F) const {
  const auto deficient = bonds_.deficient();
  const auto found = std::ranges::lower_bound(deficient, i, {}, &DeficientParticle::particle);
  return found != deficient.end() && found->particle == i ? completeGradient(*found, F) : F;
}

template <class Material>
double MlsElasticity<Material>::energy(ConstVec3Span x) {
  loadDisplacement(x);
  std::span<const DeficientParticle> deficient = bonds_.deficient();
  return parallelSum(bonds_.particleCount(), 0.0, [&](Index begin, Index end) {
    auto next =
        std::lower_bound(deficient.begin(), deficient.end(), begin,
                         [](const DeficientParticle& d, Index i) { return d.particle < i; });
    double sum = 0;
    for (Index i = begin; i < end; ++i) {
      const Mat3 F = deformationOf(i);
      const bool missing = next != deficient.end() && next->particle == i;
      sum += bonds_.volume(i) * material_.energy(missing ? completeGradient(*next++, F) : F);
      if (control_) sum += controlEnergy(x, i, F - Mat3::Identity());
    }
    return sum;
  });
}

template <class Material>
double MlsElasticity<Material>::energyOf(ConstVec3Span x, std::span<const Index> particles) const {
  double sum = 0;
  for (const Index i : particles) {
    const Mat3 F = fittedAt(x, i);
    sum += bonds_.volume(i) * material_.energy(completed(i, F));
    if (control_) sum += controlEnergy(x, i, F - Mat3::Identity());
  }
  return sum;
}

template <class Material>
double MlsElasticity<Material>::controlEnergy(ConstVec3Span x, Index i, const Mat3& H) const {
  double sum = 0;
  const Vec3 ui = x[i] - bonds_.reference(i);
  const Bond* bond = bonds_.own(i);
  for (const Bond* end = bond + bonds_.ownRow(i).size; bond != end; ++bond) {
    const Vec3 u = x[bond->particle] - bonds_.reference(bond->particle) - ui;
    const Vec3 X = bonds_.reference(bond->particle) - bonds_.reference(i);
    sum += 0.5 * bond->control * (u - H * X).squaredNorm();
  }
  return sum;
}

template <class Material>
void MlsElasticity<Material>::prepareTangent(ConstVec3Span x, TangentKind kind) {
  filtered_ = kind == TangentKind::filtered;
  const auto count = static_cast<std::size_t>(bonds_.particleCount());
  if (filtered_)
    filteredTangents_.resize(count);
  else
    tangents_.resize(count);
  loadDisplacement(x);
  const auto prepare = [this](Index i, const Mat3& F) {
    if (filtered_)
      filteredTangents_[i] = material_.filteredTangent(F);
    else
      tangents_[i] = material_.tangent(F);
  };
  parallelFor(bonds_.particleCount(), [&](Index i) { prepare(i, deformationOf(i)); });
  deficientF_.clear();
  for (const DeficientParticle& d : bonds_.deficient()) {
    deficientF_.push_back(completeGradient(d, deformationOf(d.particle)));
    prepare(d.particle, deficientF_.back());
  }
}

template <class Material>
template <class Add>
void MlsElasticity<Material>::assembleStiffness(Add&& add) const {
  std::span<const DeficientParticle> deficient = bonds_.deficient();
  std::size_t next = 0;
  std::vector<Index> ids;
  std::vector<Vec3> g;  // derivative of F_i with respect to each of ids
  for (Index i = 0; i < bonds_.particleCount(); ++i) {
    ids.assign(1, i);
    g.assign(1, Vec3::Zero());
    const Bond* bond = bonds_.own(i);
    for (Index k = 0; k < bonds_.ownRow(i).size; ++k) {
      ids.push_back(bond[k].particle);
      g.emplace_back(bond[k].g[0], bond[k].g[1], bond[k].g[2]);
      g[0] -= g.back();
    }
    const bool missing = next < deficient.size() && deficient[next].particle == i;
    std::array<std::array<Mat3, 3>, 3> stress;  // [component of u][direction of the gradient]
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        Mat3 dF = Mat3::Zero();
        dF(c, k) = bonds_.volume(i);
        if (missing) dF = completeDerivative(deficient[next], deficientF_[next], dF);
        stress[c][k] = tangentStress(i, dF);
      }
    next += missing;
    for (std::size_t b = 0; b < ids.size(); ++b) {
      std::array<Mat3, 3> response;  // stress of a unit motion of b
      for (int c = 0; c < 3; ++c)
        response[c] = stress[c][0] * g[b][0] + stress[c][1] * g[b][1] + stress[c][2] * g[b][2];
      for (std::size_t a = 0; a < ids.size(); ++a) {
        Mat3 block;
        for (int c = 0; c < 3; ++c) block.col(c) = response[c] * g[a];
        add(ids[a], ids[b], block);
      }
    }
    if (control_) assembleControl(i, ids, g, add);
  }
}

// e_j = u_j - u_i - sum_k (g_k . X_ij) (u_k - u_i) is linear in the motion: its coefficients
// squared.
template <class Material>
template <class Add>
void MlsElasticity<Material>::assembleControl(Index i, std::span<const Index> ids,
                                              std::span<const Vec3> g, Add&& add) const {
  const auto size = static_cast<Eigen::Index>(ids.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd e(size);
  for (Eigen::Index j = 1; j < size; ++j) {
    const Vec3 X = bonds_.reference(ids[j]) - bonds_.reference(i);
    for (Eigen::Index a = 0; a < size; ++a) e[a] = -g[a].dot(X);
    e[j] += 1;
    e[0] -= 1;
    stiffness += bonds_.own(i)[j - 1].control * e * e.transpose();
  }
  for (Eigen::Index a = 0; a < size; ++a)
    for (Eigen::Index b = 0; b < size; ++b) add(ids[a], ids[b], stiffness(a, b) * Mat3::Identity());
}

}  // namespace stroma
