// SPDX-License-Identifier: Apache-2.0
#include "components/stability/initial_motion.h"

#include <cmath>

#include "core/random.h"

namespace stroma {
namespace {

Vec3 randomVector(UniformRandom& random) {
  const double x = random(), y = random();
  return {x, y, random()};
}

}  // namespace

void InitialMotion::configure() {
  if (deformation->size() != 9) {
    error(deformation, "value-count", "has 9 numbers, the rows of a 3x3 matrix");
  }
  if (checkerboard.isSet() && n->size() != 3) {
    error(checkerboard, "attr-required", "needs the lattice's 'n', three whole numbers");
  }
}

void InitialMotion::bind() {
  const std::vector<Vec3>& rest = points;
  if (checkerboard.isSet() && rest.size() != static_cast<std::size_t>((*n)[0]) *
                                                 static_cast<std::size_t>((*n)[1]) *
                                                 static_cast<std::size_t>((*n)[2])) {
    error(n, "value-count", "names another number of points than 'points' has");
    return;
  }
  Vec3 middle = Vec3::Zero(), low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& p : rest) {
    middle += p / static_cast<double>(rest.size());
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Mat3 F =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(deformation->data());
  UniformRandom random(static_cast<std::uint64_t>(*seed));
  std::vector<Vec3> x = rest, v(rest.size()), u(rest.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (scramble) x[i] = low + randomVector(random).cwiseProduct(high - low);
    x[i] = F * (x[i] - middle);
    const double angle = twist * (rest[i].x() - low.x());
    x[i] = middle + Eigen::AngleAxisd(angle, Vec3::UnitX()) * x[i];
    if (checkerboard.isSet()) {
      const std::size_t nx = static_cast<std::size_t>((*n)[0]),
                        ny = static_cast<std::size_t>((*n)[1]);
      const bool odd = (i % nx + i / nx % ny + i / (nx * ny)) % 2 == 1;
      x[i] += Vec3::Constant(odd ? -checkerboard : *checkerboard);
    }
    if (noise > 0) x[i] += noise * (2 * randomVector(random) - Vec3::Ones());
    v[i] = *linearVelocity + angularVelocity->cross(x[i] - middle);
    u[i] = x[i] - rest[i];
  }
  position.set(std::move(x));
  velocity.set(std::move(v));
  displacement.set(std::move(u));
}

}  // namespace stroma
