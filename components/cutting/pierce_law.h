// SPDX-License-Identifier: Apache-2.0
// When a blade that presses a surface goes in.
#pragma once

#include "core/attribute.h"
#include "core/interfaces/stress_field.h"
#include "core/interfaces/tool.h"

namespace stroma {

enum class PierceCriterion { none, stress, force, energy };
template <>
struct EnumNames<PierceCriterion> {
  static constexpr std::array<std::pair<PierceCriterion, std::string_view>, 4> names{
      {{PierceCriterion::none, "none"},
       {PierceCriterion::stress, "stress"},
       {PierceCriterion::force, "force"},
       {PierceCriterion::energy, "energy"}}};
};

// Largest von Mises stress (Pa) of the particles named.
[[nodiscard]] double vonMisesNear(const StressField& field, const StateView& at,
                                  std::span<const Index> particles);

// What a blade has done to the surface since it touched.
class Pressing {
 public:
  // At the beginning of a step: the contacts that the last one ended with act while the tool moves
  // from its previous pose to its pose.
  void add(const Tool& tool);
  void forget() { *this = {}; }

  [[nodiscard]] bool touches() const { return touches_; }
  [[nodiscard]] double force() const { return force_; }  // N, of all contacts together
  // Where it presses hardest.
  [[nodiscard]] const Vec3& point() const { return point_; }
  // Work of the tool on the surface (J) over the area that the blade would have cut on its way:
  // the way from where it touched, times the length over which it presses, no shorter than the way.
  [[nodiscard]] double energyPerArea() const;

  static constexpr std::size_t numberCount = 13;
  void save(std::span<double> numbers) const;
  void restore(std::span<const double> numbers);

 private:
  bool touches_ = false;
  double force_ = 0, work_ = 0, width_ = 0;
  Vec3 point_ = Vec3::Zero(), start_ = Vec3::Zero(), now_ = Vec3::Zero();
};

}  // namespace stroma
