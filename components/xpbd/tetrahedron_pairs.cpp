// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/tetrahedron_pairs.h"

#include <Eigen/LU>
#include <atomic>

namespace stroma {
namespace {

Mat3 edgesOf(ConstVec3Span x, const Tetrahedron& nodes) {
  const Vec3* p = x.data();
  Mat3 edges;
  for (int a = 1; a < 4; ++a) edges.col(a - 1) = p[nodes[a]] - p[nodes[0]];
  return edges;
}

}  // namespace

ElementFlaw TetrahedronPairs::findFlaw(ConstVec3Span rest, std::span<const Tetrahedron> elements) {
  constexpr double flat = 1e-12;
  ElementFlaw flaw;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Mat3 edges = edgesOf(rest, elements[e]);
    const double size = edges.colwise().norm().maxCoeff();
    if (edges.determinant() > flat * size * size * size) continue;
    if (flaw.count++ == 0) flaw.first = static_cast<Index>(e);
  }
  return flaw;
}

TetrahedronPairs::TetrahedronPairs(ConstVec3Span rest, std::span<const Tetrahedron> elements)
    : count_(static_cast<Index>(elements.size())) {
  const Colouring colouring = colourElements({elements.front().data(), 4 * elements.size()}, 4,
                                             static_cast<Index>(rest.size()));
  const std::span<const Index> order(colouring.order);
  begin_.push_back(0);
  for (std::size_t c = 0; c + 1 < colouring.begin.size(); ++c) {
    for (Index k = colouring.begin[c]; k < colouring.begin[c + 1]; k += lanes) {
      const Index count = std::min<Index>(lanes, colouring.begin[c + 1] - k);
      const auto chosen =
          order.subspan(static_cast<std::size_t>(k), static_cast<std::size_t>(count));
      batches_.push_back(makeBatch(rest, elements, chosen));
    }
    begin_.push_back(static_cast<Index>(batches_.size()));
  }
}

TetrahedronPairs::Batch TetrahedronPairs::makeBatch(ConstVec3Span rest,
                                                    std::span<const Tetrahedron> elements,
                                                    std::span<const Index> chosen) {
  Batch batch;
  batch.count = static_cast<int>(chosen.size());
  batch.deviatoricMultiplier = batch.volumeMultiplier = Lanes::Zero();
  for (int lane = 0; lane < lanes; ++lane) {
    const Index e = chosen[static_cast<std::size_t>(lane < batch.count ? lane : 0)];
    batch.nodes[lane] = elements[static_cast<std::size_t>(e)];
    const Mat3 edges = edgesOf(rest, batch.nodes[lane]), inverse = edges.inverse();
    batch.volume[lane] = edges.determinant() / 6;
    for (int a = 0; a < 3; ++a)
      for (int j = 0; j < 3; ++j) batch.restInverse[a][j][lane] = inverse(a, j);
  }
  return batch;
}

void TetrahedronPairs::clearMultipliers() {
  for (Batch& batch : batches_) batch.deviatoricMultiplier = batch.volumeMultiplier = Lanes::Zero();
}

std::uint64_t TetrahedronPairs::project(const XpbdParticles& particles, double damping) {
  std::atomic<std::uint64_t> skipped = 0;
  forEachByColour(begin_, 32, [&](std::size_t k) {
    const int left = projectBatch(batches_[k], particles, damping);
    if (left > 0) skipped += static_cast<std::uint64_t>(left);
  });
  return skipped;
}

TetrahedronPairs::Pair TetrahedronPairs::pairOf(const Batch& batch, ConstVec3Span x) {
  Pair::Vectors edges;
  for (int lane = 0; lane < lanes; ++lane) {
    const Tetrahedron& nodes = batch.nodes[lane];
    const Vec3& origin = x[static_cast<std::size_t>(nodes[0])];
    for (int a = 0; a < 3; ++a) {
      const Vec3& other = x[static_cast<std::size_t>(nodes[a + 1])];
      for (int i = 0; i < 3; ++i) edges[a][i][lane] = other[i] - origin[i];
    }
  }
  return {edges, batch.restInverse};
}

// Gradients along which the particles can move.
void TetrahedronPairs::restrictPair(Pair& pair, const Batch& batch,
                                    const XpbdParticles& particles) {
  for (auto* gradients : {&pair.dDeviatoric, &pair.dVolume}) {
    for (int lane = 0; lane < lanes; ++lane) {
      for (int a = 0; a < 4; ++a) {
        auto& g = (*gradients)[a];
        const Vec3 free =
            particles.movable(batch.nodes[lane][a], Vec3(g[0][lane], g[1][lane], g[2][lane]));
        for (int i = 0; i < 3; ++i) g[i][lane] = free[i];
      }
    }
  }
}

// (1 + K (1 + c) G W G^T) dL = -K (C + c G (x - start)) - L,   x += W G^T dL, with the gradients G,
// the inverse masses W, the stiffnesses K = h^2 V (mu, l) and c = damping / h. That is the equation
// of Macklin et al. 2016 times K, so that nothing is divided by a stiffness.
int TetrahedronPairs::projectBatch(Batch& batch, const XpbdParticles& particles,
                                   double damping) const {
  const Vec3Span x = particles.x;
  Pair pair = pairOf(batch, x);
  if (!particles.partlyHeld.empty()) restrictPair(pair, batch, particles);

  const double c = damping / particles.h;
  Lanes valueD = pair.deviatoric, valueV = pair.volume - (1 + moduli_.mu / moduli_.l);
  std::array<Lanes, 4> w;
  Lanes wDD = Lanes::Zero(), wDV = wDD, wVV = wDD;
  for (int a = 0; a < 4; ++a) {
    const auto &gD = pair.dDeviatoric[a], &gV = pair.dVolume[a];
    for (int lane = 0; lane < lanes; ++lane)
      w[a][lane] = particles.inverseMass[static_cast<std::size_t>(batch.nodes[lane][a])];
    wDD += w[a] * (gD[0] * gD[0] + gD[1] * gD[1] + gD[2] * gD[2]);
    wDV += w[a] * (gD[0] * gV[0] + gD[1] * gV[1] + gD[2] * gV[2]);
    wVV += w[a] * (gV[0] * gV[0] + gV[1] * gV[1] + gV[2] * gV[2]);
    if (c == 0) continue;
    for (int i = 0; i < 3; ++i) {
      Lanes moved;
      for (int lane = 0; lane < lanes; ++lane) {
        const auto n = static_cast<std::size_t>(batch.nodes[lane][a]);
        moved[lane] = x[n][i] - particles.start[n][i];
      }
      valueD += c * gD[i] * moved;
      valueV += c * gV[i] * moved;
    }
  }

  const Lanes scale = particles.h * particles.h * batch.volume;
  const Lanes kD = scale * moduli_.mu, kV = scale * moduli_.l;
  const Lanes sD = (1 + c) * kD, sV = (1 + c) * kV;
  const Lanes bD = -kD * valueD - batch.deviatoricMultiplier;
  const Lanes bV = -kV * valueV - batch.volumeMultiplier;
  const Lanes det = 1 + sD * wDD + sV * wVV + sD * sV * (wDD * wVV - wDV * wDV);
  const Lanes stepD = ((1 + sV * wVV) * bD - sD * wDV * bV) / det;
  const Lanes stepV = ((1 + sD * wDD) * bV - sV * wDV * bD) / det;
  return move(batch, pair, w, stepD, stepV, x);
}

int TetrahedronPairs::move(Batch& batch, const Pair& pair, const std::array<Lanes, 4>& w,
                           const Lanes& stepD, const Lanes& stepV, Vec3Span x) const {
  std::array<std::array<Lanes, 3>, 4> moves;
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i)
      moves[a][i] = w[a] * (stepD * pair.dDeviatoric[a][i] + stepV * pair.dVolume[a][i]);
  }
  int skipped = 0;
  for (int lane = 0; lane < batch.count; ++lane) {
    bool flat = moduli_.mu == 0;
    for (int k = 0; flat && k < 9; ++k) flat = pair.dVolume[k / 3 + 1][k % 3][lane] == 0;
    if (flat || !std::isfinite(stepD[lane] + stepV[lane])) {
      ++skipped;
      continue;
    }
    batch.deviatoricMultiplier[lane] += stepD[lane];
    batch.volumeMultiplier[lane] += stepV[lane];
    for (int a = 0; a < 4; ++a) {
      Vec3& own = x[static_cast<std::size_t>(batch.nodes[lane][a])];
      for (int i = 0; i < 3; ++i) own[i] += moves[a][i][lane];
    }
  }
  return skipped;
}

}  // namespace stroma
