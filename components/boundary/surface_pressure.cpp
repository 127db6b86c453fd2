// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/surface_pressure.h"

#include "components/boundary/ramp.h"
#include "core/parallel.h"

namespace stroma {
namespace {

std::size_t at3(const Triangle& t, std::size_t corner) {
  return static_cast<std::size_t>(t[corner % 3]);
}

Mat3 crossMatrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace

void SurfacePressureForceField::bind() {
  if (!surface_.select(*this, state(), topology.get(), triangles, triangleIndices)) return;
  makeRoom();
  apex_.setZero();
  const auto around = surface_.closed() ? surface_.nodes() : surface_.rim();
  for (const Index i : around) apex_ += state().rest()[static_cast<std::size_t>(i)];
  if (!around.empty()) apex_ /= static_cast<double>(around.size());
}

void SurfacePressureForceField::makeRoom() {
  const auto count = static_cast<std::size_t>(surface_.count());
  areaForce_.resize(count, Vec3::Zero());
  opposite_.resize(count, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  swept_.resize(count, Vec3::Zero());
  sum_.resize(count, Vec3::Zero());
}

void SurfacePressureForceField::topologyChanged(const TopologyChange& change) {
  if (surface_.follow(*this, change)) makeRoom();
}

void SurfacePressureForceField::topologyRestored() {
  if (surface_.restore()) makeRoom();
}

double SurfacePressureForceField::pressureAt(double time) const {
  return pressure * smoothRamp(time, rampTime);
}

void SurfacePressureForceField::addForce(const StateView& at, Vec3Span f) {
  const double p = pressureAt(at.time);
  parallelFor(surface_.count(), [&](Index k) {
    const Triangle& t = surface_.triangles()[static_cast<std::size_t>(k)];
    const Vec3 &a = at.x[at3(t, 0)], &b = at.x[at3(t, 1)], &c = at.x[at3(t, 2)];
    areaForce_[static_cast<std::size_t>(k)] = (p / 6) * (b - a).cross(c - a);
  });
  parallelFor(static_cast<Index>(surface_.nodes().size()), [&](Index n) {
    Vec3 sum = Vec3::Zero();
    surface_.forCorners(
        n, [&](Index triangle, Index) { sum += areaForce_[static_cast<std::size_t>(triangle)]; });
    f[static_cast<std::size_t>(surface_.nodes()[static_cast<std::size_t>(n)])] += sum;
  });
}

double SurfacePressureForceField::volume(ConstVec3Span x) const {
  double six = 0;
  for (const Triangle& t : surface_.triangles()) {
    six += (x[at3(t, 0)] - apex_).dot((x[at3(t, 1)] - apex_).cross(x[at3(t, 2)] - apex_));
  }
  return six / 6;
}

double SurfacePressureForceField::potentialEnergy(const StateView& at) const {
  return -pressureAt(at.time) * volume(at.x);
}

void SurfacePressureForceField::linearize(const StateView& at) {
  linearPressure_ = pressureAt(at.time);
  parallelFor(surface_.count(), [&](Index k) {
    const Triangle& t = surface_.triangles()[static_cast<std::size_t>(k)];
    for (std::size_t c = 0; c < 3; ++c) {
      opposite_[static_cast<std::size_t>(k)][c] = at.x[at3(t, c + 1)] - at.x[at3(t, c + 2)];
    }
  });
}

// With d_c the edge opposite to corner c, the force on every corner changes by p/6 sum_c u_c x d_c.
// The transposed derivative takes w to p/6 d_c x sum_b w_b on corner c. Half of each is the
// symmetric part.
void SurfacePressureForceField::addTangentProduct(ConstVec3Span dx, double stiffness, double,
                                                  Vec3Span df) const {
  const double factor = stiffness * linearPressure_ / 12;
  if (factor == 0) return;
  parallelFor(surface_.count(), [&](Index n) {
    const auto k = static_cast<std::size_t>(n);
    const Triangle& t = surface_.triangles()[k];
    swept_[k] = sum_[k] = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      swept_[k] += dx[at3(t, c)].cross(opposite_[k][c]);
      sum_[k] += dx[at3(t, c)];
    }
  });
  parallelFor(static_cast<Index>(surface_.nodes().size()), [&](Index n) {
    Vec3 change = Vec3::Zero();
    surface_.forCorners(n, [&](Index triangle, Index corner) {
      const auto k = static_cast<std::size_t>(triangle);
      change += swept_[k] + opposite_[k][static_cast<std::size_t>(corner)].cross(sum_[k]);
    });
    df[static_cast<std::size_t>(surface_.nodes()[static_cast<std::size_t>(n)])] += factor * change;
  });
}

bool SurfacePressureForceField::addPattern(BlockPattern& pattern, Index offset) const {
  for (const Triangle& t : surface_.triangles()) {
    const std::array<Index, 3> nodes{offset + t[0], offset + t[1], offset + t[2]};
    pattern.addClique(nodes);
  }
  return true;
}

void SurfacePressureForceField::addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                                           double) const {
  const double factor = stiffness * linearPressure_ / 12;
  for (std::size_t k = 0; k < surface_.triangles().size(); ++k) {
    const Triangle& t = surface_.triangles()[k];
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        matrix.add(offset + t[a], offset + t[b],
                   factor * (crossMatrix(opposite_[k][a]) - crossMatrix(opposite_[k][b])));
      }
    }
  }
}

}  // namespace stroma
