// SPDX-License-Identifier: Apache-2.0
#include "limit_step.h"

#include <Eigen/LU>
#include <algorithm>
#include <random>

namespace stroma::bench {
namespace {

using Lanes = double __attribute__((vector_size(32)));

double dot(Lanes a, Lanes b) {
  const Lanes m = a * b;
  return m[0] + m[1] + m[2];
}

struct Link {
  double g[3];
  Index j;
};

struct Columns {
  Lanes c[3];
};

}  // namespace

struct LimitStep::Data {
  std::size_t count, perParticle;
  std::vector<Link> own, back;
  std::vector<std::size_t> backBegin;
  std::vector<Lanes> self, u, v;
  std::vector<Columns> stress;

  Lanes force(std::size_t i) const {
    Lanes f =
        stress[i].c[0] * self[i][0] + stress[i].c[1] * self[i][1] + stress[i].c[2] * self[i][2];
    for (std::size_t b = backBegin[i]; b < backBegin[i + 1]; ++b) {
      const Columns& s = stress[static_cast<std::size_t>(back[b].j)];
      f += s.c[0] * back[b].g[0] + s.c[1] * back[b].g[1] + s.c[2] * back[b].g[2];
    }
    return f;
  }

  // second Piola-Kirchhoff stress of St. Venant-Kirchhoff with unit Lame parameters, times F
  Columns stressOf(std::size_t i) const {
    Lanes F[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    for (std::size_t k = 0; k < perParticle; ++k) {
      const Link& link = own[i * perParticle + k];
      const Lanes d = u[static_cast<std::size_t>(link.j)] - u[i];
      for (int c = 0; c < 3; ++c) F[c] += d * link.g[c];
    }
    const double e00 = 0.5 * (dot(F[0], F[0]) - 1), e11 = 0.5 * (dot(F[1], F[1]) - 1),
                 e22 = 0.5 * (dot(F[2], F[2]) - 1), e01 = 0.5 * dot(F[0], F[1]),
                 e12 = 0.5 * dot(F[1], F[2]), e02 = 0.5 * dot(F[0], F[2]);
    const double trace = e00 + e11 + e22;
    return {{F[0] * (2 * e00 + trace) + F[1] * (2 * e01) + F[2] * (2 * e02),
             F[0] * (2 * e01) + F[1] * (2 * e11 + trace) + F[2] * (2 * e12),
             F[0] * (2 * e02) + F[1] * (2 * e12) + F[2] * (2 * e22 + trace)}};
  }
};

LimitStep::LimitStep(Index nx, Index ny, Index nz, Index neighbours)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.count =
      static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
  d.perParticle = static_cast<std::size_t>(neighbours);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.15, 0.15);
  std::vector<Vec3> X;
  for (Index z = 0; z < nz; ++z) {
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) {
        X.emplace_back(x + jitter(random), y + jitter(random), z + jitter(random));
      }
    }
  }
  d.self.assign(d.count, Lanes{});
  d.backBegin.assign(d.count + 1, 0);
  std::vector<std::pair<double, Index>> near;
  for (std::size_t i = 0; i < d.count; ++i) {
    const auto id = static_cast<Index>(i);
    const Index x = id % nx, y = id / nx % ny, z = id / (nx * ny);
    near.clear();
    for (Index c = std::max(0, z - 2); c <= std::min(nz - 1, z + 2); ++c) {
      for (Index b = std::max(0, y - 2); b <= std::min(ny - 1, y + 2); ++b) {
        for (Index a = std::max(0, x - 2); a <= std::min(nx - 1, x + 2); ++a) {
          const Index j = a + nx * (b + ny * c);
          if (j != id) near.emplace_back((X[static_cast<std::size_t>(j)] - X[i]).squaredNorm(), j);
        }
      }
    }
    std::ranges::nth_element(near, near.begin() + neighbours - 1);
    near.resize(d.perParticle);
    std::ranges::sort(near);
    const double support = 1.44 * near.back().first;
    Mat3 M = Mat3::Zero();
    for (const auto& [squared, j] : near) {
      const Vec3 r = X[static_cast<std::size_t>(j)] - X[i];
      M += std::pow(1 - squared / support, 3) * r * r.transpose();
    }
    const Mat3 inverse = M.inverse();
    for (const auto& [squared, j] : near) {
      const Vec3 g =
          std::pow(1 - squared / support, 3) * inverse * (X[static_cast<std::size_t>(j)] - X[i]);
      d.own.push_back({{g.x(), g.y(), g.z()}, j});
      d.self[i] -= Lanes{g.x(), g.y(), g.z(), 0};
      ++d.backBegin[static_cast<std::size_t>(j) + 1];
    }
  }
  for (std::size_t i = 0; i < d.count; ++i) d.backBegin[i + 1] += d.backBegin[i];
  d.back.resize(d.own.size());
  std::vector<std::size_t> at(d.backBegin.begin(), d.backBegin.end() - 1);
  for (std::size_t k = 0; k < d.own.size(); ++k) {
    Link link = d.own[k];
    const auto j = static_cast<std::size_t>(link.j);
    link.j = static_cast<Index>(k / d.perParticle);
    d.back[at[j]++] = link;
  }
  d.v.assign(d.count, Lanes{});
  d.stress.resize(d.count);
  for (std::size_t i = 0; i < d.count; ++i) {
    const auto phase = static_cast<double>(i);
    d.u.push_back(Lanes{1e-3 * std::sin(phase), 1e-3 * std::cos(phase), 0, 0});
  }
}

LimitStep::~LimitStep() = default;

void LimitStep::step() {
  Data& d = *data_;
  constexpr double dt = 1e-3;
  for (std::size_t i = 0; i < d.count; ++i) d.stress[i] = d.stressOf(i);
  for (std::size_t i = 0; i < d.count; ++i) d.v[i] -= dt * d.force(i);
  for (std::size_t i = 0; i < d.count; ++i) d.u[i] += dt * d.v[i];
}

}  // namespace stroma::bench
