// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/pierce_law.h"

#include <algorithm>
#include <cmath>

#include "components/material/von_mises.h"

namespace stroma {

double vonMisesNear(const StressField& field, const StateView& at,
                    std::span<const Index> particles) {
  double most = 0;
  for (const Index i : particles) {
    most = std::max(most, vonMisesStress(field.stressAt(at, i)));
  }
  return most;
}

void Pressing::add(const Tool& tool) {
  Vec3 total = Vec3::Zero();
  double hardest = 0;
  std::vector<Vec3> points;
  for (const Contact& c : tool.contacts()) {
    const double f = c.force.norm();
    if (!(f > 0)) continue;
    total += c.force;
    points.push_back(c.point);
    if (f > hardest) {
      hardest = f;
      point_ = c.point;
    }
  }
  if (points.empty()) return forget();
  if (!touches_) start_ = tool.previousPose().position;
  touches_ = true;
  force_ = total.norm();
  now_ = tool.pose().position;
  // the tissue's force on the tool is against the motion while the tool does work
  work_ -= total.dot(tool.pose().position - tool.previousPose().position);
  width_ = 0;
  for (const Vec3& p : points)
    for (const Vec3& q : points) width_ = std::max(width_, (p - q).norm());
}

double Pressing::energyPerArea() const {
  const double way = (now_ - start_).norm();
  return touches_ && way > 0 ? work_ / (way * std::max(way, width_)) : 0;
}

void Pressing::save(std::span<double> numbers) const {
  numbers[0] = touches_ ? 1 : 0;
  numbers[1] = force_;
  numbers[2] = work_;
  numbers[3] = width_;
  std::size_t k = 4;
  for (const Vec3* a : {&point_, &start_, &now_})
    for (const double value : *a) numbers[k++] = value;
}

void Pressing::restore(std::span<const double> numbers) {
  touches_ = numbers[0] != 0;
  force_ = numbers[1];
  work_ = numbers[2];
  width_ = numbers[3];
  std::size_t k = 4;
  for (Vec3* a : {&point_, &start_, &now_})
    for (double& value : *a) value = numbers[k++];
}

}  // namespace stroma
