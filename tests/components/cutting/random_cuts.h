// SPDX-License-Identifier: Apache-2.0
// Random bodies and sweeps of every kind that cutting has to bear.
#pragma once

#include <numbers>
#include <random>
#include <string>

#include "components/cutting/exact_predicates.h"
#include "tests/components/cutting/cut_runner.h"
#include "tests/components/cutting/test_bodies.h"

namespace stroma::test {

struct RandomCut {
  std::string kind;
  std::vector<Sweep> sweeps;  // one after the other
  int steps = 30;             // each
};

// A block, a block full of ties, a bent shell, a ball, the scenes' cornea and liver, an open sheet
// in turn.
SimplicialComplex randomBody(unsigned seed);

// One cut of a random kind for each seed: every invariant after every change, a repeated cut
// changes nothing, pieces never grow together. Prints seeds and the worst figures.
void checkRandomCuts(unsigned first, unsigned count);

// Cuts through a body; `pitch`: size of its mesh.
class RandomCuts {
 public:
  RandomCuts(unsigned seed, const SimplicialComplex& body, double pitch)
      : random_(seed), low_(body.vertex(0)), high_(low_), pitch_(pitch) {
    for (Index v = 0; v < body.vertexCount(); ++v) {
      low_ = low_.cwiseMin(body.vertex(v));
      high_ = high_.cwiseMax(body.vertex(v));
    }
  }

  RandomCut next() {
    switch (random_() % 9) {
      case 0:
        return {"straight", {line()}};
      case 1:
        return {"curved", {curve()}};
      case 2:
        return {"crossing", {line(), line()}};
      case 3:
        return tee();
      case 4:
        return almostSame();
      case 5:
        return {"loop", {loop()}, 60};
      case 6:
        return again();
      case 7:
        return resumed();
      default:
        return {"touching", {tangent()}};
    }
  }

  // A single sweep.
  Sweep once() { return random_() % 2 ? line() : curve(); }
  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }

 private:
  Vec3 extent() const { return high_ - low_; }
  double size() const { return extent().norm(); }
  Vec3 inside() {
    return low_ + extent().cwiseProduct(Vec3(uniform(.2, .8), uniform(.2, .8), uniform(.2, .8)));
  }
  Vec3 direction() {
    Vec3 d;
    do d = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    while (d.norm() > 1 || d.norm() < 0.1);
    return d.normalized();
  }
  // blade that enters from outside and ends somewhere: inside (half of them) or beyond the body
  Sweep line() {
    const Vec3 centre = inside(), along = direction(), up = along.cross(direction()).normalized();
    const double from = size(), to = uniform(-0.3, 1.0) * size();
    const double depth = uniform(0, 1) < 0.5 ? uniform(0, 0.2) * size() : size();
    return straight(centre - from * along, centre + to * along, size() * up, -depth * up);
  }
  Sweep curve() {
    const Vec3 centre = inside(), along = direction(), up = along.cross(direction()).normalized();
    const Vec3 side = along.cross(up);
    const double from = size() / 2, bend = uniform(-0.3, 0.3) * size(),
                 to = uniform(0, 0.5) * size();
    const double twist = uniform(-0.3, 0.3), depth = uniform(0.1, 1) * size(), length = size();
    return [=](double s) {
      const Vec3 x =
          centre + (s * (from + to) - from) * along + bend * std::sin(std::numbers::pi * s) * side;
      const Vec3 axis = (up + twist * std::sin(5 * s) * side).normalized();
      return blade(x + length * axis, x - depth * axis);
    };
  }
  Sweep loop() {
    const Vec3 centre = inside();
    Vec3 axis = direction();
    axis.z() += 2;
    axis.normalize();
    const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
    const double radius = uniform(2.5, 4) * pitch_, depth = uniform(0.1, 1) * size();
    const double length = size(), full = 2 * std::numbers::pi * (uniform(0, 1) < 0.5 ? 1 : 1.1);
    return [=](double s) {
      const Vec3 x = centre + radius * (std::cos(full * s) * u + std::sin(full * s) * w);
      return blade(x + length * axis, x - depth * axis);
    };
  }
  RandomCut tee() {
    const Vec3 centre = inside(), along = direction(), up = along.cross(direction()).normalized();
    const Vec3 side = along.cross(up);
    const double l = size();
    const Sweep first = straight(centre - l * along, centre + l * along, l * up, -l * up);
    const Sweep onto = straight(centre - l * side, centre, l * up, -l * up);
    const Sweep beyond = straight(centre - l * side, centre + 0.7 * pitch_ * side, l * up, -l * up);
    return {"tee", {first, random_() % 2 ? onto : beyond}};
  }
  // crossing at 1e-6 degrees
  RandomCut almostSame() {
    const Vec3 centre = inside(), along = direction(), up = along.cross(direction()).normalized();
    const Vec3 side = along.cross(up);
    const double l = size(), tilt = 1e-6 * std::numbers::pi / 180;
    return {"almost same",
            {straight(centre - l * along, centre + l * along, l * up, -l * up),
             straight(centre - l * (along + tilt * side), centre + l * (along + tilt * side),
                      l * up, -l * up)}};
  }
  RandomCut again() {
    const Sweep s = random_() % 2 ? line() : curve();
    return {"again", {s, s}};
  }
  RandomCut resumed() {
    const Sweep s = line();
    return {"resumed",
            {[=](double t) { return s(0.6 * t); }, [=](double t) { return s(0.6 + 0.4 * t); }}};
  }
  // in a plane through the body's box face, or a little beside it
  Sweep tangent() {
    const int axis = static_cast<int>(random_() % 3);
    Vec3 along = Vec3::Zero(), up = Vec3::Zero(), centre = (low_ + high_) / 2;
    along[(axis + 1) % 3] = 1;
    up[(axis + 2) % 3] = 1;
    const double offsets[] = {0, 1e-9, 1e-3, 0.05, 0.12};
    centre[axis] = (random_() % 2 ? low_ : high_)[axis] +
                   (random_() % 2 ? 1 : -1) * offsets[random_() % 5] * pitch_;
    return straight(centre - size() * along, centre + size() * along, size() * up, -size() * up);
  }

  std::mt19937 random_;
  Vec3 low_, high_;
  double pitch_;
};

}  // namespace stroma::test
